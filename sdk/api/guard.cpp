#include "api/guard.h"

namespace vfit::api {

std::string& last_error() {
    thread_local std::string message;
    return message;
}

vfit_result remember(vfit_result code, const char* message) noexcept {
    try {
        last_error() = message;
    } catch (...) {
        last_error().clear();
    }
    return code;
}

}  // namespace vfit::api
