// The commands of the vfit command line. Each adds itself to the parser; its callback does the work, and an
// exception it throws ends the program (client/command_line.h).
#pragma once

#include "client/client.h"
#include "client/command_line.h"

namespace vfit::tools {

void add_info(Command& app);
void add_measure(Command& app);
void add_cameras(Command& app);
void add_calibrate(Command& app);
void add_estimate(Command& app);
void add_validate(Command& app);
void add_size(Command& app);
void add_track(Command& app);
void add_motion(Command& app);
void add_fit(Command& app);
void add_record(Command& app);
void add_alter(Command& app);
void add_plot(Command& app);
void add_character(Command& app);
void add_wear(Command& app);

/// "--joints", "--user-map" and "--active".
void add_track_options(Command& command, TrackOptions& options);

}  // namespace vfit::tools
