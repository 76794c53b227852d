// The plug-in's one exception: a result and a sentence that names the file. It never leaves the plug-in.
#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

#include "vfit.h"

namespace recording {

class Failure : public std::runtime_error {
public:
    Failure(vfit_result result, const std::string& message) : std::runtime_error(message), result_(result) {}
    vfit_result result() const { return result_; }

private:
    vfit_result result_;
};

template <typename... Parts>
[[noreturn]] void fail(vfit_result result, const Parts&... parts) {
    std::ostringstream stream;
    (stream << ... << parts);
    throw Failure(result, stream.str());
}

}  // namespace recording
