#include "client/program.h"

#include <algorithm>
#include <cstdio>
#include <iostream>

#include "client/client.h"

namespace vfit::tools {

int run_program(CLI::App& app, const char* name, int argc, char** argv) {
    try {
        app.parse(argc, argv);
        if (!std::cout.flush()) throw Failure("standard output: cannot be written");
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cout.flush();  // what was printed before the failure stands before its line
        std::string line = error.what();
        std::replace(line.begin(), line.end(), '\n', ' ');
        std::fprintf(stderr, "%s: %s\n", name, line.c_str());
        return 1;
    }
}

}  // namespace vfit::tools
