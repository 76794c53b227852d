// Foot-skate correction on the character (paper, Algorithm 6): planted feet are held where they were
// recorded, hips and knees follow by inverse kinematics, and the root takes what the legs cannot reach: its height and
// the pelvis' roll, which nobody sees, follow the knees, which everybody does.
#pragma once

#include <array>

#include "motion/foot_pin.h"
#include "motion/rest_pose.h"

namespace vfit {

// Where a body's limbs foreshorten (a squat), the character's tracked foot strays from the person's by a good
// part of a shank; further than this something else is wrong and the foot follows.
inline constexpr float kCharacterLeashM = 0.4f;

class FootPlanter {
public:
    void reset() { *this = FootPlanter(); }

    /// Changes the legs and the root of `pose` and fills its contacts, root_correction and foot_correction_m.
    /// `drags`: how far the person slid each planted foot since the last call.
    void apply(const Skeleton& skeleton, const RestPose& rest, const bool planted[2], const Vec3 drags[2],
               float dt_s, Pose& pose);

    /// Where joint limits have since taken the legs off their places, the root gives way and the legs follow again.
    void hold(const Skeleton& skeleton, const RestPose& rest, const bool planted[2], Pose& pose) const;

private:
    std::array<FootPin, 2> pins_{FootPin(kCharacterLeashM), FootPin(kCharacterLeashM)};
    bool known_ = false;
    std::array<float, 2> weight_{};  // of each planted foot in the root's height; eases in and out
    Vec3 root_shift_{0.0f};  // d_root beside that; fades when no leg needs it
    std::array<Vec3, 2> shown_{};  // where the last apply() put the ankles
};

}  // namespace vfit
