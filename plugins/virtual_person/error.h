// The one exception type of this plug-in: a result code and a sentence. The plug-in's border turns it into
// the return value and last_error.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include "vfit.h"

namespace vfit::virtual_person {

class Error : public std::runtime_error {
public:
    Error(vfit_result code, const std::string& message) : std::runtime_error(message), code_(code) {}
    vfit_result code() const { return code_; }

private:
    vfit_result code_;
};

template <typename... Parts>
[[noreturn]] void fail(vfit_result code, const Parts&... parts) {
    std::ostringstream stream;
    (stream << ... << parts);
    throw Error(code, stream.str());
}

/// Fails with the library's own sentence unless a call of vfit.h succeeded.
inline void check(vfit_result result, const char* call) {
    if (result >= 0) return;
    char why[512];
    vfit_last_error(why, sizeof why);
    fail(result, "virtual: ", call, ": ", why);
}

}  // namespace vfit::virtual_person
