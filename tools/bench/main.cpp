// vfit-bench: speed and accuracy figures.
#include "bench/bench.h"

int main(int argc, char** argv) {
    using namespace vfit::tools;
    add_stages(app);
    add_people(app);
    add_recordings(app);
    add_track(app);
    add_cloth(app);
    add_user_map(app);
    add_fit(app);
    return run_program(app, "vfit-bench", argc, argv);
}
