// vfit: the command line. Exit 0: done; 1: failed, with one line that says why; 2: wrong usage.
#include <cstdio>

#include "client/client.h"
#include "commands/commands.h"

int main(int argc, char** argv) {
    CLI::App app{"Virtual fitting from one depth camera: measure, size, move, dress."};
    app.require_subcommand(1);
    app.set_help_all_flag("--help-all", "Help of all commands");
    using namespace vfit::tools;
    add_info(app);
    add_measure(app);
    add_size(app);
    add_track(app);
    add_motion(app);
    add_fit(app);
    add_record(app);
    add_cook(app);
    add_plot(app);
    try {
        app.parse(argc, argv);
        return 0;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "vfit: %s\n", error.what());
        return 1;
    }
}
