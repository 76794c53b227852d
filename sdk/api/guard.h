// The one way from the C ABI into the library: every exported function's body runs inside guard(), which
// turns any exception into a result code and this thread's last error.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "core/error.h"
#include "vfit.h"

namespace vfit::api {

/// This thread's last error text.
std::string& last_error();

/// Must not throw: it runs when memory may be short.
vfit_result remember(vfit_result code, const char* message) noexcept;

template <typename Body>
vfit_result guard(Body&& body) noexcept {
    try {
        return body();
    } catch (const Error& error) {
        return remember(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        return remember(VFIT_ERROR_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
        return remember(VFIT_ERROR_UNKNOWN, error.what());
    } catch (...) {
        return remember(VFIT_ERROR_UNKNOWN, "unknown exception");
    }
}

}  // namespace vfit::api
