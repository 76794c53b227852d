// vfit: the command line.
#include "commands/commands.h"
#include "offline/offline.h"

int main(int argc, char** argv) {
    using namespace vfit::tools;
    return run_program(
        "vfit", "Virtual fitting from one depth camera: measure, size, move, dress.",
        {add_info, add_measure, add_cameras, add_calibrate, add_validate, add_estimate, add_size, add_track,
         add_motion, add_fit, add_record, add_cook, add_alter, add_plot, add_character, add_refit, add_wear},
        argc, argv);
}
