// vfit-bench: speed and accuracy figures.
#include "bench/bench.h"
#include "client/program.h"

int main(int argc, char** argv) {
    CLI::App app{"Speed and accuracy figures of vfit, each printed by one command."};
    app.require_subcommand(1);
    using namespace vfit::tools;
    add_stages(app);
    add_people(app);
    add_recordings(app);
    add_track(app);
    add_cloth(app);
    add_user_map(app);
    return run_program(app, "vfit-bench", argc, argv);
}
