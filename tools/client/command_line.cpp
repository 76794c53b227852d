#include "client/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "client/client.h"

namespace vfit::tools {

namespace {

CLI::Option& option_of(void* option) { return *static_cast<CLI::Option*>(option); }
CLI::App& app_of(void* app) { return *static_cast<CLI::App*>(app); }

std::string version_text() {
    const uint32_t version = vfit_version();  // as VFIT_MAKE_VERSION packs it
    return std::to_string(version >> 22) + "." + std::to_string(version >> 12 & 0x3ff) + "." +
           std::to_string(version & 0xfff);
}

}  // namespace

Argument& Argument::required() { return option_of(option_).required(), *this; }
Argument& Argument::positive() {
    const auto fault = [](const std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        return end != text.c_str() && *end == 0 && value > 0.0 ? "" : "\"" + text + "\" is no number above 0";
    };
    return option_of(option_).check(fault), *this;
}
Argument& Argument::within(int low, int high) {
    return option_of(option_).check(CLI::Range(low, high)), *this;
}
Argument& Argument::existing_folder() { return option_of(option_).check(CLI::ExistingDirectory), *this; }
Argument& Argument::one_of(const std::vector<std::string>& values) {
    return option_of(option_).check(CLI::IsMember(values)), *this;
}
Argument& Argument::check(std::function<std::string(const std::string&)> fault) {
    return option_of(option_).check(std::move(fault)), *this;
}

Command Command::add_subcommand(const char* name, const char* help) {
    return Command(app_of(app_).add_subcommand(name, help));
}

template <typename T>
Argument Command::add_option(const char* name, T& value, const char* help) {
    return Argument(app_of(app_).add_option(name, value, help));
}
template Argument Command::add_option(const char*, std::string&, const char*);
template Argument Command::add_option(const char*, std::vector<std::string>&, const char*);
template Argument Command::add_option(const char*, int32_t&, const char*);
template Argument Command::add_option(const char*, uint32_t&, const char*);
template Argument Command::add_option(const char*, uint64_t&, const char*);
template Argument Command::add_option(const char*, float&, const char*);
template Argument Command::add_option(const char*, double&, const char*);

Argument Command::add_option_function(const char* name, std::function<void(const std::string&)> set,
                                      const char* help) {
    return Argument(app_of(app_).add_option_function<std::string>(name, std::move(set), help));
}

void Command::add_flag(const char* name, bool& value, const char* help) {
    app_of(app_).add_flag(name, value, help);
}

void Command::callback(std::function<void()> work) { app_of(app_).callback(std::move(work)); }

int run_program(const char* name, const char* help, const std::vector<void (*)(Command&)>& commands, int argc,
                char** argv) {
    CLI::App app{help};
    app.require_subcommand(1);
    app.set_version_flag("--version", version_text());
    app.set_help_all_flag("--help-all", "Help of all commands");
    Command root(&app);
    for (const auto add : commands) add(root);
    try {
        app.parse(argc, argv);
        if (!std::cout.flush()) throw Failure("standard output: cannot be written");
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const WrongUsage& wrong) {
        std::fprintf(stderr, "%s: %s\nRun with --help for more information.\n", name, wrong.what());
        return 2;
    } catch (const std::exception& error) {
        std::cout.flush();  // what was printed before the failure stands before its line
        std::string line = error.what();
        std::replace(line.begin(), line.end(), '\n', ' ');
        std::fprintf(stderr, "%s: %s\n", name, line.c_str());
        return 1;
    }
}

}  // namespace vfit::tools
