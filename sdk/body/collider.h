// What cloth collides with: a sphere at a joint, or the tapered capsule of two spheres. World space.
#pragma once

#include "math/types.h"
#include "vfit.h"

namespace vfit {

struct Collider {
    int joint = 0;  // VFIT_JOINT_*
    Vec3 center{0.0f};
    float radius = 0.0f;
    int joint_b = -1;  // -1: a sphere
    Vec3 center_b{0.0f};
    float radius_b = 0.0f;

    bool is_capsule() const { return joint_b >= 0; }
};

}  // namespace vfit
