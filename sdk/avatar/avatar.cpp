#include "avatar/avatar.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"

namespace vfit {

namespace {

// A limb's twist in more steps than this changes no section by a thousandth.
constexpr uint32_t kMaxTwistSteps = 16;

float lowest(std::span<const Vec3> positions) {
    float y = positions.front().y;
    for (const Vec3& p : positions) y = std::min(y, p.y);
    return y;
}

uint32_t checked_twist_steps(const AvatarDesc& desc) {
    if (desc.twist_steps < 1 || desc.twist_steps > kMaxTwistSteps)
        fail(VFIT_ERROR_ARGUMENT, "twist_steps is ", desc.twist_steps, ", not 1 to ", kMaxTwistSteps);
    return desc.single_bones ? 0 : desc.twist_steps;
}

Skin split_skin(const AvatarDesc& desc, const AvatarRig& rig, const Mesh& rest, std::vector<SkinBones>& bones,
                std::vector<SkinWeights>& weights) {
    if (!desc.single_bones) split_limb_weights(rest.positions, rig.limbs(), bones, weights);
    return Skin(bones, weights, rest.positions, rest.normals);
}

}  // namespace

Avatar::Avatar(const std::shared_ptr<const BodyModel>& model, const AvatarDesc& desc,
               std::span<const float> shape, const Vec2& scale)
    : Avatar(body_source(model, desc.detail, desc.sex, shape, scale), desc) {}

Avatar::Avatar(AvatarSource source, const AvatarDesc& desc)
    : topology_(std::move(source.topology)),
      paper_colliders_(desc.paper_colliders),
      is_body_(source.is_body),
      rest_(std::move(source.rest)),
      rig_(std::move(source.bones), lowest(rest_.positions), checked_twist_steps(desc)),
      skin_bones_(std::move(source.skin_bones)),
      skin_weights_(std::move(source.skin_weights)),
      skin_(split_skin(desc, rig_, rest_, skin_bones_, skin_weights_)),
      skinning_(desc.skinning),
      matrices_(rig_.bones().size()) {
    // The clothes of a character are skin too, and lie where the rule for bodies would not have them.
    if (is_body_) creases_ = Creases(rig_, *topology_, rest_.positions, skin_bones_, skin_weights_);
    if (desc.limbs_clear) {
        limbs_clear_.emplace(rig_, rest_.positions, topology_->parts);
        std::vector<uint32_t> all(rest_.positions.size());
        std::iota(all.begin(), all.end(), 0u);
        creased_ = creases_.mesh_of(all, rest_.positions);
    }
    place_joints();
    measure_inner_spheres();
    const Mesh standing = measuring_mesh(kStaturePosture);
    for (const Vec3& p : standing.positions) stature_m_ = std::max(stature_m_, p.y);

    Pose t_pose;
    t_pose.hips_position = skeleton().offset[VFIT_BONE_HIPS];
    move(t_pose);
}

std::vector<BoneAxis> Avatar::bone_axes(std::span<const Mat4> matrices) const {
    const auto posed = [&](int bone, const Vec3& rest) {
        return Vec3(matrices[size_t(bone)] * Vec4(rest, 1.0f));
    };
    std::vector<BoneAxis> axes;
    for (int i = 0; i < int(rig_bones().size()); ++i)
        axes.push_back(
            {posed(i, rig_bones()[size_t(i)].rest_head), posed(i, rig_bones()[size_t(i)].rest_tail)});
    for (const LimbChain& limb : limbs())
        for (const int bone : limb.rig_bones)
            axes[size_t(bone)] = {posed(limb.rig_bones.front(), limb.near_joint),
                                  posed(limb.rig_bones.back(), limb.far_joint)};
    return axes;
}

void Avatar::move(const Pose& pose) {
    rig_.pose(pose, posed_, matrices_);
    pose_ = pose;
    if (!limbs_clear_) return;
    limbs_clear_->run(posed_, matrices_, arms_before_, pose_);
    rig_.pose(pose_, posed_, matrices_);
}

void Avatar::skin(const SkinTarget& target, const Axes& axes, Jobs& jobs) {
    skin_in(matrices_, target, axes, scratch_, jobs);
}

void Avatar::skin_in(std::span<const Mat4> matrices, const SkinTarget& target, const Axes& axes,
                     Skin::Scratch& scratch, Jobs& jobs) const {
    skin_.pose(matrices, skinning_, axes, target, scratch, jobs);
    if (limbs_clear_) creases_.open(matrices, creased_, target, axes, jobs);
}

void Avatar::pose(const Pose& pose, Jobs& jobs) {
    move(pose);
    positions_.resize(skin_.vertex_count());
    normals_.resize(skin_.vertex_count());
    SkinTarget target;
    target.positions = positions_.data();
    target.normals = normals_.data();
    skin(target, Axes(), jobs);
}

}  // namespace vfit
