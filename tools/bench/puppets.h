// Puppets that stroll, step aside, march, lunge, hop, turn and kick on feet that roll over heel and ball.
// Nothing was learnt from them or fitted to them; they share no code with the virtual sensor's people.
#pragma once

#include "bench/motion_people.h"

namespace vfit::tools {

/// Each kind of motion by as many puppets; the tracked joints are the true ones, without rotations.
std::vector<PersonStream> puppets(uint32_t count);
/// One that stands on straight legs.
PersonStream straight_puppet();

}  // namespace vfit::tools
