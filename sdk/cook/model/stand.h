// Where a modelled garment is held on a body before it settles.
#pragma once

#include <vector>

#include "cook/body/body_outline.h"
#include "cook/drape/settle.h"
#include "cook/model/surface.h"

namespace vfit {

struct Standing {
    std::vector<Vec3> places;  // one a vertex
    HangsOn hangs_on = HangsOn::nothing;
    Vec3 moved{0.0f};
    Hold hold;
    float deepest_m = 0.0f;     // that it lies in the body
    float inside_share = 0.0f;  // of its vertices that lie in it by more than a centimetre
};

/// Moved up or down, and forward or back, from the unknown body that it was modelled on: cloth over both
/// shoulders to the body's shoulders; else the upper opening to where the body is as wide, between hips and
/// waist, if the crotch is not above the body's there; what is worn higher stays where it is.
Standing stand(const Surface& surface, const BodyOutline& outline, const MeshQuery& skin, float thickness_m);

/// Clear of the skin, where a little of it lies within: each vertex by itself.
std::vector<Vec3> pushed_out(std::vector<Vec3> places, const MeshQuery& skin, float thickness_m);

}  // namespace vfit
