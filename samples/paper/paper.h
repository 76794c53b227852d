// The commands of vfit-paper.
#pragma once

#include "client/command_line.h"

namespace vfit::tools {

/// Tables 1 to 4.
void add_tables(Command& app);
/// Figures 4, 8 and 9.
void add_figures(Command& app);

}  // namespace vfit::tools
