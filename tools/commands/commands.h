// The commands of the vfit command line. Each adds itself to the parser; its callback does the work, and an
// exception it throws ends the program (client/program.h).
#pragma once

#include <CLI/CLI.hpp>

#include "client/client.h"

namespace vfit::tools {

void add_info(CLI::App& app);
void add_measure(CLI::App& app);
void add_size(CLI::App& app);
void add_track(CLI::App& app);
void add_motion(CLI::App& app);
void add_fit(CLI::App& app);
void add_record(CLI::App& app);
void add_cook(CLI::App& app);
void add_plot(CLI::App& app);

/// "--joints" and "--user-map".
void add_track_options(CLI::App& command, TrackOptions& options);

}  // namespace vfit::tools
