// The ease that a worn garment tells of against what its pattern was drawn with.
#pragma once

#include "bench/targets.h"
#include "client/client.h"

namespace vfit::tools {

/// Every design of the project in the size that is nearest to the default body, on that body: at rest with many sub-steps, and as a
/// fitting room shows it.
Json judge_ease(vfit_context context, bool quiet, Targets& targets);

}  // namespace vfit::tools
