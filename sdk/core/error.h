// The one exception type of the library: a result code and a sentence. The guard in sdk/api turns it
// into the return value and vfit_last_error.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include "vfit.h"

namespace vfit {

class Error : public std::runtime_error {
public:
    Error(vfit_result code, const std::string& message) : std::runtime_error(message), code_(code) {}
    vfit_result code() const { return code_; }

private:
    vfit_result code_;
};

/// The parts written one after the other: text("frame ", 3, " is cut").
template <typename... Parts>
std::string text(const Parts&... parts) {
    std::ostringstream stream;
    (stream << ... << parts);
    return stream.str();
}

template <typename... Parts>
[[noreturn]] void fail(vfit_result code, const Parts&... parts) {
    throw Error(code, text(parts...));
}

}  // namespace vfit
