// Whether a depth image can be what its camera says: of a wrong unit, or of values that are no depths, people
// would be looked for in vain.
#pragma once

#include "frame/depth_image.h"

namespace vfit {

/// VFIT_ERROR_DATA with the cause: a field of view above 150 degrees, a median depth above 12 m or below 5
/// cm, raw disparities. False: too few pixels have a reading to tell.
bool check_depth(const DepthImage& image);

}  // namespace vfit
