#include "body/skeleton.h"

namespace vfit {

namespace {

struct BoneEntry {
    const char* name;
    int parent;
};

constexpr BoneEntry kBones[kBoneCount] = {
    {"hips", -1},
    {"spine", VFIT_BONE_HIPS},
    {"chest", VFIT_BONE_SPINE},
    {"upperChest", VFIT_BONE_CHEST},
    {"neck", VFIT_BONE_UPPER_CHEST},
    {"head", VFIT_BONE_NECK},
    {"leftShoulder", VFIT_BONE_UPPER_CHEST},
    {"leftUpperArm", VFIT_BONE_LEFT_SHOULDER},
    {"leftLowerArm", VFIT_BONE_LEFT_UPPER_ARM},
    {"leftHand", VFIT_BONE_LEFT_LOWER_ARM},
    {"rightShoulder", VFIT_BONE_UPPER_CHEST},
    {"rightUpperArm", VFIT_BONE_RIGHT_SHOULDER},
    {"rightLowerArm", VFIT_BONE_RIGHT_UPPER_ARM},
    {"rightHand", VFIT_BONE_RIGHT_LOWER_ARM},
    {"leftUpperLeg", VFIT_BONE_HIPS},
    {"leftLowerLeg", VFIT_BONE_LEFT_UPPER_LEG},
    {"leftFoot", VFIT_BONE_LEFT_LOWER_LEG},
    {"leftToes", VFIT_BONE_LEFT_FOOT},
    {"rightUpperLeg", VFIT_BONE_HIPS},
    {"rightLowerLeg", VFIT_BONE_RIGHT_UPPER_LEG},
    {"rightFoot", VFIT_BONE_RIGHT_LOWER_LEG},
    {"rightToes", VFIT_BONE_RIGHT_FOOT},
};

}  // namespace

const char* bone_name(int bone) { return bone >= 0 && bone < kBoneCount ? kBones[bone].name : nullptr; }

int bone_parent(int bone) { return bone >= 0 && bone < kBoneCount ? kBones[bone].parent : -2; }

PosedSkeleton forward_kinematics(const Skeleton& skeleton, const Pose& pose) {
    PosedSkeleton out;
    for (int b = 0; b < kBoneCount; ++b) {
        const auto i = static_cast<size_t>(b);
        const int parent = kBones[b].parent;
        if (parent < 0) {
            out.position[i] = pose.hips_position;
            out.rotation[i] = pose.rotation[i];
            continue;
        }
        const auto p = static_cast<size_t>(parent);
        out.position[i] = out.position[p] + out.rotation[p] * skeleton.offset[i];
        out.rotation[i] = glm::normalize(out.rotation[p] * pose.rotation[i]);
    }
    return out;
}

}  // namespace vfit
