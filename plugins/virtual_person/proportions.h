// The lengths of the person's legs, which decide where the hips are when the feet stand on the floor; and the
// directions of the limbs in the T-pose.
#pragma once

#include <array>

#include "types.h"

namespace vfit::virtual_person {

/// Offsets in the T-pose, world axes.
struct Leg {
    Vec3 hip;           // from the hips bone
    Vec3 thigh, shank;  // hip to knee, knee to ankle
    Vec3 foot;          // ankle to the ball of the foot
};

struct Proportions {
    std::array<Leg, 2> leg;
    std::array<Vec3, 2> upper_arm, forearm;  // shoulder to elbow, elbow to wrist
    float ankle_height_m = 0.08f;            // above the sole of the flat foot
};

/// A person of average build, where no avatar is at hand: segment lengths for a stature of 1.75 m by the
/// ratios of Drillis and Contini 1966 (thigh 0.245, shank 0.246, foot height 0.039 of the stature).
Proportions average_proportions();

}  // namespace vfit::virtual_person
