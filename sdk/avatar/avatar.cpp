#include "avatar/avatar.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/error.h"

namespace vfit {

namespace {

// A limb's twist in more steps than this changes no section by a thousandth.
constexpr uint32_t kMaxTwistSteps = 16;

void check(const BodyModel* model, const AvatarDesc& desc, std::span<const float> shape, const Vec2& scale) {
    if (!model) fail(VFIT_ERROR_ARGUMENT, "an avatar needs a body model");
    if (desc.detail > kCoarseBody)
        fail(VFIT_ERROR_ARGUMENT, "detail ", desc.detail, " is not a level of the body (0 to ", kCoarseBody, ")");
    if (desc.twist_steps < 1 || desc.twist_steps > kMaxTwistSteps)
        fail(VFIT_ERROR_ARGUMENT, "twist_steps is ", desc.twist_steps, ", not 1 to ", kMaxTwistSteps);
    if (!shape.empty() && shape.size() != model->parameters().size())
        fail(VFIT_ERROR_ARGUMENT, "the shape has ", shape.size(), " values, the body has ",
             model->parameters().size(), " parameters");
    for (const float value : shape)
        if (!std::isfinite(value)) fail(VFIT_ERROR_ARGUMENT, "a shape value is not finite");
    if (!std::isfinite(scale.x) || !std::isfinite(scale.y) || scale.x <= 0.0f || scale.y <= 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "the scale ", scale.x, ", ", scale.y, " is not positive and finite");
}

EvaluatedBody scaled_body(const BodyModel& model, vfit_sex sex, std::span<const float> shape,
                          const Vec2& scale) {
    EvaluatedBody body;
    if (shape.empty())
        model.evaluate(model.default_shape(sex), body);
    else
        model.evaluate(shape, body);
    const Vec3 factors(scale.x, scale.y, scale.x);
    for (auto* list : {&body.positions, &body.bone_heads, &body.bone_tails})
        for (Vec3& p : *list) p *= factors;
    return body;
}

Mesh rest_mesh(const BodyModel& model, uint32_t level, const EvaluatedBody& body) {
    const BodyTopology& topology = model.topology(level);
    Mesh mesh;
    model.subdivide(level, body.positions, mesh.positions);
    compute_normals(mesh.positions, topology.indices, mesh.normals);
    mesh.positions.reserve(topology.render_vertex_count);
    mesh.normals.reserve(topology.render_vertex_count);
    for (const uint32_t source : topology.seam_sources) {
        mesh.positions.push_back(mesh.positions[source]);
        mesh.normals.push_back(mesh.normals[source]);
    }
    mesh.uvs = topology.uvs;
    mesh.indices = topology.render_indices;
    return mesh;
}

/// Root of the middle finger of that side of the rig (".L", ".R"), or the tail of its hand.
Vec3 knuckle(const BodyModel& model, const EvaluatedBody& body, int hand) {
    const auto wrist = static_cast<size_t>(model.rig_bone(hand));
    const std::string_view finger = hand == VFIT_BONE_LEFT_HAND ? "finger3-1.L" : "finger3-1.R";
    for (size_t i = 0; i < model.bones().size(); ++i)
        if (model.bones()[i].name == finger) return body.bone_heads[i];
    return body.bone_tails[wrist];
}

AvatarRig make_rig(const BodyModel& model, const EvaluatedBody& body, float floor_y, uint32_t twist_steps) {
    std::vector<AvatarBone> bones;
    for (size_t i = 0; i < model.bones().size(); ++i) {
        const RigBone& b = model.bones()[i];
        bones.push_back({b.name, b.parent, b.bone, body.bone_heads[i], body.bone_tails[i]});
    }
    for (const int hand : {VFIT_BONE_LEFT_HAND, VFIT_BONE_RIGHT_HAND})
        bones[static_cast<size_t>(model.rig_bone(hand))].rest_tail = knuckle(model, body, hand);
    return AvatarRig(std::move(bones), floor_y, twist_steps);
}

float lowest(std::span<const Vec3> positions) {
    float y = positions.front().y;
    for (const Vec3& p : positions) y = std::min(y, p.y);
    return y;
}

}  // namespace

/// What the constructor makes in one go from the model, before the members are filled.
struct Avatar::Parts {
    Mesh rest;
    AvatarRig rig;
    std::vector<SkinBones> skin_bones;
    std::vector<SkinWeights> skin_weights;

    static Parts make(const BodyModel* model, const AvatarDesc& desc, std::span<const float> shape,
                      const Vec2& scale) {
        check(model, desc, shape, scale);
        const EvaluatedBody body = scaled_body(*model, desc.sex, shape, scale);
        const BodyTopology& topology = model->topology(desc.detail);
        Mesh rest = rest_mesh(*model, desc.detail, body);
        const uint32_t twist_steps = desc.single_bones ? 0 : desc.twist_steps;
        AvatarRig rig = make_rig(*model, body, lowest(rest.positions), twist_steps);
        std::vector<SkinBones> bones = topology.skin_bones;
        std::vector<SkinWeights> weights = topology.skin_weights;
        if (!desc.single_bones) split_limb_weights(rest.positions, rig.limbs(), bones, weights);
        return {std::move(rest), std::move(rig), std::move(bones), std::move(weights)};
    }
};

Avatar::Avatar(std::shared_ptr<const BodyModel> model, const AvatarDesc& desc, std::span<const float> shape,
               const Vec2& scale)
    : Avatar(model, desc, Parts::make(model.get(), desc, shape, scale)) {}

Avatar::Avatar(std::shared_ptr<const BodyModel> model, const AvatarDesc& desc, Parts parts)
    : model_(std::move(model)),
      topology_(&model_->topology(desc.detail)),
      paper_colliders_(desc.paper_colliders),
      rest_(std::move(parts.rest)),
      rig_(std::move(parts.rig)),
      skin_bones_(std::move(parts.skin_bones)),
      skin_weights_(std::move(parts.skin_weights)),
      skin_(skin_bones_, skin_weights_, rest_.positions, rest_.normals),
      skinning_(desc.skinning),
      matrices_(rig_.bones().size()) {
    place_joints();
    measure_inner_spheres();
    const Mesh standing = measuring_mesh(kStaturePosture);
    for (const Vec3& p : standing.positions) stature_m_ = std::max(stature_m_, p.y);

    Pose t_pose;
    t_pose.hips_position = skeleton().offset[VFIT_BONE_HIPS];
    move(t_pose);
}

void Avatar::move(const Pose& pose) {
    rig_.pose(pose, posed_, matrices_);
    pose_ = pose;
}

void Avatar::skin(const SkinTarget& target, const Axes& axes, Jobs& jobs) {
    skin_.pose(matrices_, skinning_, axes, target, scratch_, jobs);
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
