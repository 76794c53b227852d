// The humanoid bones of a character (VRM names, VFIT_BONE_* of vfit.h), its pose and its proportions.
// All of it speaks of a T-pose in which every bone has the axes of the world (facing +Z, Y up, the
// character's left is +X): a pose of identities is that T-pose.
#pragma once

#include <array>
#include <cstdint>

#include "math/types.h"
#include "vfit.h"

namespace vfit {

inline constexpr int kBoneCount = VFIT_BONE_COUNT;

/// "leftUpperArm" for VFIT_BONE_LEFT_UPPER_ARM; null for an unknown id.
const char* bone_name(int bone);
/// -1 for hips, -2 for an unknown id; parents stand before children.
int bone_parent(int bone);

/// Proportions: where each bone starts, from its parent's start, in the T-pose. offset[HIPS] is the
/// hips' place above the floor point between the feet.
struct Skeleton {
    std::array<Vec3, kBoneCount> offset{};
    float ankle_height = 0.08f;  // of the foot bone's start above the sole, standing
};

struct Pose {
    int64_t time_ns = 0;
    uint32_t contacts = 0;                  // VFIT_CONTACT_*
    Vec3 hips_position{0, 1, 0};            // world
    std::array<Quat, kBoneCount> rotation;  // local to the parent, relative to the T-pose
    Vec3 root_correction{0.0f};             // Alg. 6, d_root
    float foot_correction_m = 0.0f;         // how far the planted foot was moved (Fig. 11)

    Pose() { rotation.fill(Quat(1, 0, 0, 0)); }
};

/// World placement of every bone of that skeleton in that pose.
struct PosedSkeleton {
    std::array<Vec3, kBoneCount> position;
    std::array<Quat, kBoneCount> rotation;  // world, relative to the T-pose
};
PosedSkeleton forward_kinematics(const Skeleton& skeleton, const Pose& pose);

}  // namespace vfit
