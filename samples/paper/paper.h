// The commands of vfit-paper.
#pragma once

#include "client/command_line.h"

namespace vfit::tools {

/// Tables 1 to 4.
void add_tables(Command& app);
/// Figures 4, 8 and 9.
void add_figures(Command& app);
/// Figures 5, 6, 7 and 11.
void add_limbs(Command& app);

}  // namespace vfit::tools
