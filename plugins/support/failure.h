// The one exception of plug-ins: a result and a sentence. It never leaves a plug-in.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include "vfit.h"

namespace plugin {

class Failure : public std::runtime_error {
public:
    Failure(vfit_result code, const std::string& message) : std::runtime_error(message), code_(code) {}
    vfit_result code() const { return code_; }

private:
    vfit_result code_;
};

template <typename... Parts>
[[noreturn]] void fail(vfit_result code, const Parts&... parts) {
    std::ostringstream stream;
    (stream << ... << parts);
    throw Failure(code, stream.str());
}

}  // namespace plugin
