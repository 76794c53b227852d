#include "frame/body.h"

#include <cstring>

#include "core/error.h"
#include "math/finite.h"

namespace vfit {

namespace {

constexpr const char* kNames[kJointCount] = {
    "HEAD",           "NECK",       "TORSO",       "LEFT_SHOULDER", "RIGHT_SHOULDER", "LEFT_ELBOW",
    "RIGHT_ELBOW",    "LEFT_HAND",  "RIGHT_HAND",  "LEFT_HIP",      "RIGHT_HIP",      "LEFT_KNEE",
    "RIGHT_KNEE",     "LEFT_FOOT",  "RIGHT_FOOT",  "PELVIS",        "CHEST",          "LEFT_CLAVICLE",
    "RIGHT_CLAVICLE", "LEFT_WRIST", "RIGHT_WRIST", "LEFT_TOES",     "RIGHT_TOES"};

}  // namespace

const char* joint_name(int joint) { return joint >= 0 && joint < kJointCount ? kNames[joint] : nullptr; }

int joint_from_name(const char* name) {
    for (int i = 0; i < kJointCount; ++i)
        if (std::strcmp(kNames[i], name) == 0) return i;
    return -1;
}

Joint joint_in(const vfit_joint& in) {
    const char* name = joint_name(in.joint);
    if (!name) fail(VFIT_ERROR_ARGUMENT, "joint ", in.joint, " is not one of VFIT_JOINT_*");
    if (in.state < VFIT_JOINT_NOT_SEEN || in.state > VFIT_JOINT_MEASURED)
        fail(VFIT_ERROR_ARGUMENT, "joint ", name, ": state ", in.state, " is not one of its values");
    Joint joint;
    joint.state = in.state;
    joint.confidence = in.confidence;
    joint.position = {in.position[0], in.position[1], in.position[2]};
    const Quat rotation(in.rotation[3], in.rotation[0], in.rotation[1], in.rotation[2]);
    if (!finite(joint.position) || !finite(rotation) || !finite(joint.confidence))
        fail(VFIT_ERROR_DATA, "joint ", name, " is not finite");
    const float length = glm::length(rotation);
    if (length > 0.5f && finite(length)) {  // all zero: unknown
        joint.rotation = rotation / length;
        joint.has_rotation = true;
    }
    return joint;
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
