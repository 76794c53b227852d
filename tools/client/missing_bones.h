// The failure of a skeleton in which bones are not found: its first line is the cause; a bone map to fill in
// and the tree of nodes follow.
#pragma once

#include "client/client.h"

namespace vfit::tools {

/// Throws the cause on, in one line; with `nodes` prints what follows instead. Other failures are thrown on
/// as they are.
void report_missing_bones(const Failure& failure, bool nodes);

}  // namespace vfit::tools
