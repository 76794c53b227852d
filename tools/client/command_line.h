// What a program takes on its command line, and how it ends: 0 done; 1 failed, with one line on standard
// error that says why; 2 wrong usage. Only the source beside this header sees the parser's own headers, which
// are slow to compile.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace vfit::tools {

/// Arguments that contradict each other or lack one: ends the program with exit code 2.
class WrongUsage : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Limits of one argument, checked before the command runs.
class Argument {
public:
    explicit Argument(void* option) : option_(option) {}
    Argument& required();
    Argument& positive();
    Argument& within(int low, int high);
    Argument& existing_folder();
    Argument& one_of(const std::vector<std::string>& values);
    /// The fault of a value; empty: none.
    Argument& check(std::function<std::string(const std::string&)> fault);

private:
    void* option_;
};

/// A command of the program. The values that arguments are bound to must outlive the parsing: commands keep
/// them in the callback.
class Command {
public:
    explicit Command(void* app) : app_(app) {}
    Command add_subcommand(const char* name, const char* help);
    /// T: a text, a list of texts, a whole number or a floating-point number.
    template <typename T>
    Argument add_option(const char* name, T& value, const char* help);
    Argument add_option_function(const char* name, std::function<void(const std::string&)> set,
                                 const char* help);
    void add_flag(const char* name, bool& value, const char* help);
    void callback(std::function<void()> work);

private:
    void* app_;
};

/// Parses the command line and runs the command that it names; returns the exit code. `name` opens the line
/// of a failure. What a command throws ends the program.
int run_program(const char* name, const char* help, const std::vector<void (*)(Command&)>& commands, int argc,
                char** argv);

}  // namespace vfit::tools
