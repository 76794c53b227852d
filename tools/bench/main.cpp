// vfit-bench: speed and accuracy figures.
#include "bench/bench.h"

int main(int argc, char** argv) {
    using namespace vfit::tools;
    return run_program(
        "vfit-bench", "Speed and accuracy figures of vfit, each printed by one command.",
        {add_stages, add_people, add_population, add_recordings, add_track, add_cloth, add_drape,
         add_user_map, add_fit, add_measure, add_scan_features, add_odd_scans, add_motion,
         add_contact_features, add_garments, add_layers, add_bodies, add_refit_bench},
        argc, argv);
}
