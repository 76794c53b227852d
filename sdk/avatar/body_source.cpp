// The body model as an avatar's source.
#include <cmath>
#include <string_view>

#include "avatar/avatar_source.h"
#include "core/error.h"

namespace vfit {

namespace {

void check_body(const BodyModel* model, uint32_t detail, std::span<const float> shape, const Vec2& scale) {
    if (!model) fail(VFIT_ERROR_ARGUMENT, "an avatar needs a body model");
    if (detail > kCoarseBody)
        fail(VFIT_ERROR_ARGUMENT, "detail ", detail, " is not a level of the body (0 to ", kCoarseBody, ")");
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

std::vector<AvatarBone> bones_of(const BodyModel& model, const EvaluatedBody& body) {
    std::vector<AvatarBone> bones;
    for (size_t i = 0; i < model.bones().size(); ++i) {
        const RigBone& b = model.bones()[i];
        bones.push_back({b.name, b.parent, b.bone, body.bone_heads[i], body.bone_tails[i]});
    }
    for (const int hand : {VFIT_BONE_LEFT_HAND, VFIT_BONE_RIGHT_HAND})
        bones[static_cast<size_t>(model.rig_bone(hand))].rest_tail = knuckle(model, body, hand);
    return bones;
}

}  // namespace

AvatarSource body_source(const std::shared_ptr<const BodyModel>& model, uint32_t detail, vfit_sex sex,
                         std::span<const float> shape, const Vec2& scale) {
    check_body(model.get(), detail, shape, scale);
    const EvaluatedBody body = scaled_body(*model, sex, shape, scale);
    const BodyTopology& topology = model->topology(detail);
    AvatarSource out;
    out.rest = rest_mesh(*model, detail, body);
    out.topology = std::shared_ptr<const BodyTopology>(model, &topology);
    out.bones = bones_of(*model, body);
    out.skin_bones = topology.skin_bones;
    out.skin_weights = topology.skin_weights;
    return out;
}

}  // namespace vfit
