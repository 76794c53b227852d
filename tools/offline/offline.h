// Commands of vfit that work on files before any program runs, with modules that are not part of the library.
#pragma once

#include "client/client.h"
#include "client/command_line.h"

namespace vfit::tools {

void add_cook(Command& app);
void add_refit(Command& app);

}  // namespace vfit::tools
