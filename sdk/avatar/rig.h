// The bones behind the avatar's skin: from the rest posture of a body to any pose of the humanoid bones.
// Bones of the rig that are no humanoid bones follow their parent rigidly, except those that share a
// limb's twist (bone splitting, section 3.3.3 of the paper): the rig's own twist bones, and those that are
// made here.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "body/skeleton.h"
#include "math/types.h"

namespace vfit {

/// Parents stand before children.
struct AvatarBone {
    std::string name;
    int parent = -1;                 // -1: root
    int bone = -1;                   // VFIT_BONE_*, or -1
    Vec3 rest_head{0.0f};            // in the space of the rest mesh
    Vec3 rest_tail{0.0f};            // of a hand: the root of the middle finger
    Quat rest_rotation{1, 0, 0, 0};  // world, of the bone's own axes
    int node = -1;                   // of the file that it came from
    bool is_twist = false;           // beside the way to the limb's end, to share in its twist
};

/// A limb of the rest posture and the rig bones that carry it, the original first, the extension last:
/// bone k of n + 1 takes the share k/n of the limb's twist.
struct LimbChain {
    int bone;                    // VFIT_BONE_*
    int end_bone;                // the humanoid bone at its far end
    Vec3 near_joint, far_joint;  // rest
    std::vector<int> rig_bones;
};

/// The line that a bone runs along; of a limb's, the whole limb's.
struct BoneAxis {
    Vec3 from, to;
    Vec3 nearest(const Vec3& p) const;
};

class AvatarRig {
public:
    /// `bones` is the model's rig, placed in the rest posture; every humanoid bone that VRM requires must be
    /// there once, else VFIT_ERROR_DATA. Where chest or upper chest are missing the bone below bends for
    /// them; a missing neck turns the head, a missing shoulder the upper arm. `twist_steps`: 0, a limb is one
    /// bone; 1, the paper's split in two; n, n - 1 bones more between these (appended behind the model's
    /// bones).
    AvatarRig(std::vector<AvatarBone> bones, float floor_y, uint32_t twist_steps);

    const std::vector<AvatarBone>& bones() const { return bones_; }
    const std::vector<LimbChain>& limbs() const { return limbs_; }
    const Skeleton& skeleton() const { return skeleton_; }
    /// -1: the rig has none.
    int rig_bone(int humanoid_bone) const { return rig_of_[static_cast<size_t>(humanoid_bone)]; }
    /// Where the bone starts in the rest mesh; a missing one where its stand-in does.
    const Vec3& rest_head(int humanoid_bone) const;

    /// Where the humanoid bones of that pose stand, and the matrix that carries the rest skin of each rig
    /// bone there (world = M * rest). A pose with a number that is not finite or a rotation of no length is
    /// refused with VFIT_ERROR_DATA and changes nothing. Does not allocate.
    void pose(const Pose& pose, PosedSkeleton& posed, std::span<Mat4> matrices) const;
    /// The pose that leaves the rest skin where it is, to half a degree: a shank takes the twist of its foot.
    Pose rest_pose() const;

private:
    void map_humanoid_bones();
    void build_limbs(uint32_t twist_steps);
    void build_t_pose(float floor_y);

    std::vector<AvatarBone> bones_;
    std::array<int, kBoneCount> rig_of_{};
    std::array<int, kBoneCount> turned_by_{};  // the bone whose world rotation the rig's one takes
    std::vector<LimbChain> limbs_;
    std::array<Quat, kBoneCount> t_pose_;  // world rotation of each humanoid bone from rest to T-pose
    std::vector<int> limb_of_;             // one a rig bone; -1: none
    std::vector<float> share_of_;          // of its limb's twist
    Skeleton skeleton_;
};

/// Where a limb ends in the direction the T-pose gives it: +-X for arms, -Y for legs; zero for the bones
/// that stand in the T-pose as they do at rest.
Vec3 t_pose_direction(int humanoid_bone);

/// VRM does without it.
bool is_optional_bone(int humanoid_bone);

}  // namespace vfit
