// From what a motion says (where the feet are, how pelvis and trunk turn) to bone rotations: the legs follow
// by inverse kinematics, so that a planted foot stays exactly where it is.
#pragma once

#include <array>

#include "proportions.h"
#include "types.h"

namespace vfit::virtual_person {

/// Where a foot is. Floor coordinates are (x, z).
struct FootState {
    Vec2 place{0, 0};           // of the ankle
    float yaw_rad = 0;          // 0: toes to +Z
    float lift_m = 0;           // of the sole above the floor
    float heel_rad = 0;         // > 0: heel up, over the ball of the foot; < 0: toes up
    bool planted = true;        // the whole sole stands
    bool rolls = false;         // only ball or heel does
    bool over_a_point = false;  // ball or heel are where the flat foot at `place` has them
};

/// What a motion says about one instant.
struct Figure {
    Vec2 root{0, 0};            // floor point below the pelvis
    float heading_rad = 0;      // of the pelvis; 0: faces +Z
    Quat pelvis = kNoRotation;  // in the heading's frame
    float drop_m = 0;           // how far the hips are below the highest place that the legs allow
    float seat_m = 0,
          seated = 0;  // height of a seat, and how far the hips are on it: 0 on the legs, 1 sitting
    std::array<FootState, 2> foot;
    std::array<Quat, VFIT_BONE_COUNT> rotation;  // local; legs and hips are overwritten by solve
    Figure() { rotation.fill(kNoRotation); }
};

/// Ready for vfit_avatar_pose.
struct BonePose {
    Vec3 hips{0, 1, 0};
    std::array<Quat, VFIT_BONE_COUNT> rotation;
    std::array<bool, 2> contact{true, true};  // the whole sole stands
    std::array<bool, 2> rolls{false, false};  // only heel or ball does
};

BonePose solve(const Proportions& proportions, const Figure& figure);

/// Rotations in world space of thigh, shank and foot that put the ankle at `ankle`; the knee points along
/// `knee_forward`. Out of reach the leg is straight and points there.
struct LegPose {
    Quat thigh, shank;
};
LegPose reach_ankle(const Leg& leg, const Vec3& hip, const Vec3& ankle, const Vec3& knee_forward);

/// Writes the local rotations of one leg below the pelvis of world rotation `pelvis`.
void set_leg(std::array<Quat, VFIT_BONE_COUNT>& rotation, int side, const Quat& pelvis, const LegPose& leg,
             const Quat& foot_world, const Quat& toes_world);

/// The farthest that the ankle of a standing person is from the hip: as in the T-pose, short of full
/// extension.
float standing_reach_m(const Leg& leg);

/// How one arm is held: a few anatomical angles, in degrees from the arm that hangs straight down, palm
/// inwards.
struct ArmAngles {
    float abduct = 0;  // away from the trunk, sideways
    float flex = 0;    // forwards
    float elbow = 0;
    float turn = 0;  // of the upper arm about itself, outwards
};
void set_arm(std::array<Quat, VFIT_BONE_COUNT>& rotation, int side, const ArmAngles& arm);

}  // namespace vfit::virtual_person
