// How both programs end: 0 done; 1 failed, with one line on standard error that says why; 2 wrong usage.
#pragma once

#include <CLI/CLI.hpp>

namespace vfit::tools {

/// Parses and runs the command; returns the exit code. `name` opens the line of a failure.
int run_program(CLI::App& app, const char* name, int argc, char** argv);

}  // namespace vfit::tools
