// Whether a garment is still around the limbs that it was put on.
#pragma once

#include <vector>

#include "bench/welded.h"

namespace vfit::tools {

/// A place inside a limb: the cross-section of the garment there is a closed line around it, or is not.
struct LimbPlace {
    vfit_joint_id from, to;
    float share;  // of the way
};
/// The middle of the upper arms and thighs, and of forearms and shanks a place nearer to elbow and knee, so
/// that a sleeve may ride up.
const std::vector<LimbPlace>& limb_places();

/// Of each of limb_places(), how often the garment goes around it: 0 is not at all, 1 once.
std::vector<float> turns_around_limbs(vfit_avatar avatar, const Welded& garment);

/// Of turns around a limb before and now: what closed around it does so no longer. A coat that is open in
/// front closes around neither leg.
bool is_off_limb(float before, float now);

}  // namespace vfit::tools
