// Directions of a skeleton's limbs in its T-pose: what rotations from positions, limits and leg inverse
// kinematics are measured against.
#pragma once

#include <array>

#include "body/skeleton.h"

namespace vfit {

/// The rotation that carries the pair (primary, secondary) to another: primary exactly, secondary as well as
/// the angle between the two allows. Any length; where a pair is parallel the secondary is ignored.
Quat align_pairs(const Vec3& primary_from, const Vec3& secondary_from, const Vec3& primary_to,
                 const Vec3& secondary_to);

enum LimbId { kLeftArm = 0, kRightArm = 1, kLeftLeg = 2, kRightLeg = 3 };
inline constexpr int kLimbCount = 4;

/// What a limb is made of: joints of the tracked body, bones of the skeleton.
struct LimbParts {
    int root, middle, end, tip;      // VFIT_JOINT_*: shoulder elbow wrist hand; hip knee ankle toes
    int parent, upper, lower, last;  // VFIT_BONE_*: last is hand or foot
    Vec3 hinge;                      // T-pose axis about which the lower bone bends, positive = flexion
    float side;                      // +1 left, -1 right
    bool leg;
};
extern const LimbParts kLimbParts[kLimbCount];

struct RestLimb {
    Vec3 upper{0, -1, 0}, lower{0, -1, 0};  // unit directions root->middle, middle->end
    Vec3 hinge{1, 0, 0};                    // kLimbParts' hinge made square to `upper`
    float upper_m = 0, lower_m = 0;
    float bend_rad = 0;  // flexion that the T-pose itself has
};

struct RestPose {
    std::array<RestLimb, kLimbCount> limbs;
    std::array<Vec3, 2> toes;                     // unit, ankle to toes, left and right
    Vec3 hip_middle{0.0f};                        // midpoint of the hip joints, from the hips bone
    Vec3 neck{0, 1, 0};                           // base of the neck, from hip_middle
    Vec3 hip_left{1, 0, 0}, chest_left{1, 0, 0};  // unit, along hip and shoulder joints
    Vec3 head{0, 1, 0};                           // unit, neck to head

    RestPose() = default;
    explicit RestPose(const Skeleton& skeleton);
    float leg_m() const {
        return 0.5f * (limbs[kLeftLeg].upper_m + limbs[kLeftLeg].lower_m + limbs[kRightLeg].upper_m +
                       limbs[kRightLeg].lower_m);
    }
};

}  // namespace vfit
