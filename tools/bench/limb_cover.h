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

/// How a garment goes around a limb at one of limb_places().
struct LimbCover {
    float turns = 0.0f;  // 0: not at all, 1: once; lines that end at a hem count as part of a turn
    bool stays = false;  // it is to stay there: what goes around an arm, or closes around a leg. The skirt of
                         // a coat that is open in front may leave a leg.
};
std::vector<LimbCover> cover_of_limbs(vfit_avatar avatar, const Welded& garment);

/// What was to stay around the limb does not go around it any longer.
bool is_off_limb(const LimbCover& before, const LimbCover& now);

}  // namespace vfit::tools
