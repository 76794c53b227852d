// Where each joint of VFIT_JOINT_* lies in a body: on a humanoid bone.
#pragma once

#include <array>

#include "vfit.h"

namespace vfit {

struct JointPlace {
    int bone;     // VFIT_BONE_*
    float along;  // from its start to its end, share of it
};

/// The hand's centre of mass: .506 of the way from the wrist to the second knuckle of the middle finger
/// (Dempster, in Winter), which in this rig lies 4/3 as far from the wrist as the finger's root, where the
/// bone ends.
inline constexpr float kHandCentre = 0.506f * 4.0f / 3.0f;

/// By joint id.
inline constexpr std::array<JointPlace, VFIT_JOINT_COUNT> kJointPlaces = {{
    {VFIT_BONE_HEAD, 0.5f},
    {VFIT_BONE_NECK, 0.0f},
    {VFIT_BONE_CHEST, 0.0f},
    {VFIT_BONE_LEFT_UPPER_ARM, 0.0f},
    {VFIT_BONE_RIGHT_UPPER_ARM, 0.0f},
    {VFIT_BONE_LEFT_LOWER_ARM, 0.0f},
    {VFIT_BONE_RIGHT_LOWER_ARM, 0.0f},
    {VFIT_BONE_LEFT_HAND, kHandCentre},
    {VFIT_BONE_RIGHT_HAND, kHandCentre},
    {VFIT_BONE_LEFT_UPPER_LEG, 0.0f},
    {VFIT_BONE_RIGHT_UPPER_LEG, 0.0f},
    {VFIT_BONE_LEFT_LOWER_LEG, 0.0f},
    {VFIT_BONE_RIGHT_LOWER_LEG, 0.0f},
    {VFIT_BONE_LEFT_FOOT, 0.0f},
    {VFIT_BONE_RIGHT_FOOT, 0.0f},
    {VFIT_BONE_HIPS, 0.0f},
    {VFIT_BONE_UPPER_CHEST, 0.0f},
    {VFIT_BONE_LEFT_SHOULDER, 0.0f},
    {VFIT_BONE_RIGHT_SHOULDER, 0.0f},
    {VFIT_BONE_LEFT_HAND, 0.0f},
    {VFIT_BONE_RIGHT_HAND, 0.0f},
    {VFIT_BONE_LEFT_TOES, 0.0f},
    {VFIT_BONE_RIGHT_TOES, 0.0f},
}};

}  // namespace vfit
