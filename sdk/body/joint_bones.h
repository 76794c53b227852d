// Where each joint of VFIT_JOINT_* lies in a body: at the start of a humanoid bone, or in its middle.
#pragma once

#include <array>

#include "vfit.h"

namespace vfit {

struct JointPlace {
    int bone;     // VFIT_BONE_*
    bool middle;  // of the bone; else its start
};

/// By joint id.
inline constexpr std::array<JointPlace, VFIT_JOINT_COUNT> kJointPlaces = {{
    {VFIT_BONE_HEAD, true},
    {VFIT_BONE_NECK, false},
    {VFIT_BONE_CHEST, false},
    {VFIT_BONE_LEFT_UPPER_ARM, false},
    {VFIT_BONE_RIGHT_UPPER_ARM, false},
    {VFIT_BONE_LEFT_LOWER_ARM, false},
    {VFIT_BONE_RIGHT_LOWER_ARM, false},
    {VFIT_BONE_LEFT_HAND, true},
    {VFIT_BONE_RIGHT_HAND, true},
    {VFIT_BONE_LEFT_UPPER_LEG, false},
    {VFIT_BONE_RIGHT_UPPER_LEG, false},
    {VFIT_BONE_LEFT_LOWER_LEG, false},
    {VFIT_BONE_RIGHT_LOWER_LEG, false},
    {VFIT_BONE_LEFT_FOOT, false},
    {VFIT_BONE_RIGHT_FOOT, false},
    {VFIT_BONE_HIPS, false},
    {VFIT_BONE_UPPER_CHEST, false},
    {VFIT_BONE_LEFT_SHOULDER, false},
    {VFIT_BONE_RIGHT_SHOULDER, false},
    {VFIT_BONE_LEFT_HAND, false},
    {VFIT_BONE_RIGHT_HAND, false},
    {VFIT_BONE_LEFT_TOES, false},
    {VFIT_BONE_RIGHT_TOES, false},
}};

}  // namespace vfit
