// Joint limits on local bone rotations (paper 3.3.2): swing and twist held in the natural ranges of human
// joints.
#pragma once

#include "body/range_of_motion.h"
#include "motion/bone_solver.h"

namespace vfit {

/// Clamps in place. Inside the ranges nothing changes. A foot that stands on the floor (`planted`, left and
/// right) is left alone: body weight bends an ankle further than its free range.
void apply_joint_limits(const RestPose& rest, const bool planted[2], BoneRotations& local,
                        const RangeOfMotion& rom = RangeOfMotion::natural());

/// The same, but a bone may be so far outside of its range. True where one was farther.
bool apply_joint_limits(const RestPose& rest, const bool planted[2], float slack_rad, BoneRotations& local,
                        const RangeOfMotion& rom = RangeOfMotion::natural());

/// Of one foot alone, `side` 0 left, 1 right.
void limit_ankle(const RangeOfMotion& rom, int side, Quat& foot);

}  // namespace vfit
