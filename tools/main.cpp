// vfit: the command line.
#include "client/program.h"
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
    return run_program(app, "vfit", argc, argv);
}
