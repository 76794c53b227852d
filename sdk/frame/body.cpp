#include "frame/body.h"

#include <cstring>

namespace vfit {

namespace {

constexpr const char* kNames[kJointCount] = {
    "HEAD",       "NECK",           "TORSO",         "LEFT_SHOULDER", "RIGHT_SHOULDER", "LEFT_ELBOW",
    "RIGHT_ELBOW", "LEFT_HAND",     "RIGHT_HAND",    "LEFT_HIP",      "RIGHT_HIP",      "LEFT_KNEE",
    "RIGHT_KNEE", "LEFT_FOOT",      "RIGHT_FOOT",    "PELVIS",        "CHEST",          "LEFT_CLAVICLE",
    "RIGHT_CLAVICLE", "LEFT_WRIST", "RIGHT_WRIST",   "LEFT_TOES",     "RIGHT_TOES"};

}  // namespace

const char* joint_name(int joint) { return joint >= 0 && joint < kJointCount ? kNames[joint] : nullptr; }

int joint_from_name(const char* name) {
    for (int i = 0; i < kJointCount; ++i)
        if (std::strcmp(kNames[i], name) == 0) return i;
    return -1;
}

int mirrored_joint(int joint) {
    // Pairs stand side by side in the enumeration, LEFT first.
    if (joint >= VFIT_JOINT_LEFT_SHOULDER && joint <= VFIT_JOINT_RIGHT_FOOT)
        return joint % 2 == 1 ? joint + 1 : joint - 1;
    if (joint >= VFIT_JOINT_LEFT_CLAVICLE && joint <= VFIT_JOINT_RIGHT_TOES)
        return joint % 2 == 1 ? joint + 1 : joint - 1;
    return joint;
}

}  // namespace vfit
