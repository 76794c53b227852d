// The ease that a worn garment tells of against what its pattern was drawn with.
#pragma once

#include "bench/targets.h"
#include "client/client.h"

namespace vfit::tools {

/// Every design of the project in the size that is nearest to the default body, on that body: standing as a
/// fitting room shows it, and with its arms held out as it was drafted on; with the usual sub-steps and
/// with 32.
Json judge_ease(vfit_context context, bool quiet, Targets& targets);

}  // namespace vfit::tools
