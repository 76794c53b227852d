// Closed-form inverse kinematics of a two-bone limb (Tolani, Goswami, Badler 2000): the middle joint lies
// on a circle about the line from the root to the goal; the law of cosines gives the circle, the pole
// direction the point on it.
#pragma once

#include "math/types.h"

namespace vfit {

struct TwoBoneSolution {
    Vec3 middle{0.0f};  // knee or elbow
    Vec3 end{0.0f};     // ankle or wrist; the goal where it can be reached
};

/// `pole` points to the side of the middle joint (the knee's front); it need not be square to anything.
/// `softness` in [0, 1): the share of the whole length over which the limb eases into full extension, so that
/// the middle joint does not snap; 0: hard.
TwoBoneSolution solve_two_bone(const Vec3& root, float upper_m, float lower_m, const Vec3& goal,
                               const Vec3& pole, float softness);

}  // namespace vfit
