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
/// Figures 2, 12, 13, 14 and 15.
void add_garments(Command& app);
/// Figure 10.
void add_rates(Command& app);
/// Table 5.
void add_meshes(Command& app);

}  // namespace vfit::tools
