// vfit-bench: speed and accuracy figures. Exit codes as vfit's.
#include <cstdio>

#include "bench/bench.h"

int main(int argc, char** argv) {
    CLI::App app{"Speed and accuracy figures of vfit, each printed by one command."};
    app.require_subcommand(1);
    using namespace vfit::tools;
    add_stages(app);
    add_people(app);
    add_recordings(app);
    add_cloth(app);
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "vfit-bench: %s\n", error.what());
        return 1;
    }
}
