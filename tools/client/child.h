// Other programs: run to their end, with what they print.
#pragma once

#include <string>
#include <vector>

namespace vfit::tools {

struct ChildResult {
    enum class End { exited, crashed, over_time } end = End::exited;
    int code = 0;  // of its exit, or of the signal that ended it
    std::string out, error;
    double seconds = 0.0;
};

/// Without standard input. It is ended after limit_s. Throws Failure where it cannot be started.
ChildResult run_child(const std::vector<std::string>& command, double limit_s);

/// The path of the program that is running.
std::string own_program();

}  // namespace vfit::tools
