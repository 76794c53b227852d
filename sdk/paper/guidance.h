// Whether a frame can be measured, and what to tell the person if not.
#pragma once

#include <cstdint>

#include "frame/body.h"
#include "frame/camera.h"
#include "track/depth_filter.h"

namespace vfit {

/// VFIT_GUIDANCE_NONE: measure it. `previous` is the same person in the frame before, or null.
/// Walking or moving the arms does not hinder a scan; bending, squatting and running do.
vfit_guidance check_frame(const FilteredDepth& depth, const Camera& camera, const Body* body,
                          const Body* previous, uint32_t person_count);

}  // namespace vfit
