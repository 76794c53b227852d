// A body that moves: made once from the body model or from a character's file, posed each frame, it gives the
// skin, the bones, the joints and the colliders of that pose.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "avatar/avatar_source.h"
#include "avatar/creases.h"
#include "avatar/limbs_clear.h"
#include "body/collider.h"
#include "body/skeleton.h"
#include "core/jobs.h"
#include "frame/body.h"

namespace vfit {

struct AvatarDesc {
    vfit_sex sex = VFIT_SEX_UNKNOWN;  // the shape where none is given
    uint32_t detail = 0;              // level of the body model
    bool single_bones = false;        // one bone a limb (Fig. 7a of the paper)
    bool paper_colliders = false;     // radii of Algorithm 2 as they are
    // Steps in which a limb's twist grows from its near to its far joint, each linearly blended. 1 is the
    // paper's two bones: at a quarter turn the blend pinches the limb's middle to half its section. With 6 a
    // forearm loses less of its volume than it does as a single bone (2 % against 3 %).
    uint32_t twist_steps = 6;
    SkinMethod skinning = SkinMethod::linear;
    bool limbs_clear = false;  // kept out of trunk and thighs: for a body that is not the person's own
};

/// Standing upright, arms hanging beside the body: the posture in which tape measures are taken.
struct MeasuringPosture {
    float arm_angle_rad = 0.2617994f;  // of the upper arms from the vertical: 15 degrees
    float feet_apart_m = 0.25f;        // between the ankle joints; feet never stand closer than touching
    bool operator==(const MeasuringPosture&) const = default;
};
/// Feet together: the posture of stature (ISO 8559-1).
inline constexpr MeasuringPosture kStaturePosture{0.2617994f, 0.0f};
/// Upper arms at 5 degrees: the posture of bideltoid breadth.
inline constexpr MeasuringPosture kBideltoidPosture{0.0872665f, 0.25f};

/// The 15 spheres of the paper's joints, then 16 capsules.
inline constexpr int kColliderCount = 31;

class Avatar {
public:
    /// `shape` has one value a parameter of the model (empty: the default body of desc.sex). `scale` is
    /// Algorithm 3's, of the body as a whole: width and depth by x, height by y. Stands in the T-pose, facing
    /// +Z over the world's origin, until the first pose().
    Avatar(const std::shared_ptr<const BodyModel>& model, const AvatarDesc& desc,
           std::span<const float> shape, const Vec2& scale);
    Avatar(AvatarSource source, const AvatarDesc& desc);

    /// Radii of Algorithm 2 by joint; 0, not measured: the largest sphere about the joint inside the skin.
    /// Measured ones are taken as they are with desc.paper_colliders, else cut to that sphere.
    void set_collider_radii(std::span<const float, kPaperJointCount> radii);

    /// Moves bones, joints and colliders. VFIT_ERROR_DATA, and nothing moves, where the pose is not finite.
    /// Does not allocate.
    void move(const Pose& pose);
    /// The skin of the last pose, render vertices, written into the host's memory in its axes. Does not
    /// allocate after the first call.
    void skin(const SkinTarget& target, const Axes& axes, Jobs& jobs);
    /// The same in another pose (skinning matrices, one a rig bone). scratch: the caller's own.
    void skin_in(std::span<const Mat4> matrices, const SkinTarget& target, const Axes& axes,
                 Skin::Scratch& scratch, Jobs& jobs) const;
    /// Both: moves, then writes positions() and normals().
    void pose(const Pose& pose, Jobs& jobs);
    int64_t time_ns() const { return pose_.time_ns; }  // of the last pose
    /// The pose as it is shown: desc.limbs_clear may have moved the arms.
    const Pose& shown_pose() const { return pose_; }
    /// Of its skin; desc.limbs_clear opens them in what skin() writes.
    const Creases& creases() const { return creases_; }

    /// The pose in which the skin is as rest() has it.
    Pose rest_pose() const { return rig_.rest_pose(); }
    /// Proportions that motion is bound to: forward_kinematics(skeleton(), pose) gives the places of the
    /// posed avatar's bones.
    const Skeleton& skeleton() const { return rig_.skeleton(); }
    const PosedSkeleton& posed_skeleton() const { return posed_; }

    /// The unposed mesh in the model's own posture, soles on y = 0: render vertices, seam copies included.
    const Mesh& rest() const { return rest_; }
    /// Render vertices of the last pose(), world, empty before; index and uv are rest()'s.
    const std::vector<Vec3>& positions() const { return positions_; }
    const std::vector<Vec3>& normals() const { return normals_; }

    const std::vector<AvatarBone>& rig_bones() const { return rig_.bones(); }
    const std::vector<LimbChain>& limbs() const { return rig_.limbs(); }
    /// world = M * rest, one a rig bone.
    std::span<const Mat4> skinning_matrices() const { return matrices_; }
    /// One a render vertex.
    std::span<const SkinBones> skin_bones() const { return skin_bones_; }
    std::span<const SkinWeights> skin_weights() const { return skin_weights_; }
    std::span<const BodyPart> parts() const { return topology_->parts; }
    /// The closed surface behind the mesh; its vertices are the first of positions().
    const BodyTopology& topology() const { return *topology_; }

    /// Every joint of the posed avatar, world, with rotation, state measured.
    Body joints() const;

    /// Posed: spheres by joint, then capsules. Does not allocate where `out` has room for kColliderCount.
    void colliders(std::vector<Collider>& out) const;
    /// Of the unposed body: where rest() is.
    void rest_colliders(std::vector<Collider>& out) const;

    /// One a rig bone, posed by those skinning matrices.
    std::vector<BoneAxis> bone_axes(std::span<const Mat4> matrices) const;

    /// Skinning matrices (one a rig bone) and colliders of a body that gets dressed: that share of the way
    /// from standing straight, arms and legs apart (0), to the pose (1). The hips are where the pose has
    /// them.
    void while_dressing(float share, std::span<Mat4> matrices, std::vector<Collider>& out) const;

    /// The same of a body in the pose, but for its legs: those are that share of the way from where they
    /// stand at rest, apart (0), to the pose (1). A garment that is carried along with the bones has its legs
    /// beside each other there, and not in each other.
    void while_closing_legs(float share, std::span<Mat4> matrices, std::vector<Collider>& out) const;

    /// The body in a measuring posture: geometric vertices (as topology().indices has them) without normals,
    /// facing +Z, soles on y = 0; and its joints where asked for.
    Mesh measuring_mesh(const MeasuringPosture& posture = {}, Body* joints = nullptr) const;

    /// Floor to crown, feet together.
    float stature() const { return stature_m_; }

private:
    void place_joints();
    void measure_inner_spheres();
    Pose measuring_pose(const MeasuringPosture& posture) const;
    float touching_feet_m() const;
    Vec3 joint_position(int joint, std::span<const Mat4> matrices) const;
    void colliders_of(std::span<const Mat4> matrices, std::vector<Collider>& out) const;
    Body joints_of(const PosedSkeleton& posed, std::span<const Mat4> matrices) const;

    std::shared_ptr<const BodyTopology> topology_;
    bool paper_colliders_, is_body_;
    Mesh rest_;
    AvatarRig rig_;
    std::vector<SkinBones> skin_bones_;
    std::vector<SkinWeights> skin_weights_;
    Skin skin_;
    struct Anchor {
        int rig_bone;
        Vec3 rest;
    };
    std::array<Anchor, kJointCount> anchors_{};  // joints in the rest mesh
    std::array<float, kPaperJointCount> inner_radii_{}, radii_{};
    float stature_m_ = 0.0f;

    SkinMethod skinning_;
    std::optional<LimbsClear> limbs_clear_;
    LimbsClear::Memory arms_before_;
    Creases creases_;
    Creases::Mesh creased_;  // the render vertices; empty without desc.limbs_clear
    Skin::Scratch scratch_;
    Pose pose_;  // arms as they are shown
    PosedSkeleton posed_;
    std::vector<Mat4> matrices_;
    std::vector<Vec3> positions_, normals_;
};

}  // namespace vfit
