#include "api/avatar_object.h"

namespace vfit::api {

namespace {

PackedBody described(const BodyModel& model, const AvatarDesc& desc, std::span<const float> shape,
                     const Vec2& scale) {
    PackedBody body;
    body.sex = desc.sex;
    body.shape =
        shape.empty() ? model.default_shape(desc.sex) : std::vector<float>(shape.begin(), shape.end());
    body.scale = scale;
    return body;
}

}  // namespace

AvatarObject::AvatarObject(Ref<Context> owner, const AvatarDesc& desc, std::span<const float> shape,
                           const Vec2& scale)
    : ContextChild(std::move(owner)),
      avatar(context->body_model(), desc, shape, scale),
      sex(desc.sex),
      detail(desc.detail),
      body(described(*context->body_model(), desc, shape, scale)),
      posed(*context),
      rest(*context) {
    make_outputs();
}

AvatarObject::AvatarObject(Ref<Context> owner, const AvatarDesc& desc, Character loaded)
    : ContextChild(std::move(owner)),
      avatar(std::move(loaded.source), desc),
      sex(VFIT_SEX_UNKNOWN),
      character(std::move(loaded)),
      posed(*context),
      rest(*context) {
    make_outputs();
}

void AvatarObject::make_outputs() {
    const size_t vertices = avatar.rest().positions.size();
    for (MeshOutput* output : {&posed, &rest}) {
        StaticStreams& topology = output->topology();
        topology.set_indices(avatar.rest().indices, context->axes);
        topology.set_uvs(avatar.rest().uvs, context->axes);
        topology.set_skin({avatar.skin_bones()[0].data(), vertices * kSkinBones},
                          {avatar.skin_weights()[0].data(), vertices * kSkinBones}, vertices);
    }
    std::vector<Mat4> identity(avatar.skinning_matrices().size(), Mat4(1.0f));
    Ref<Frame> frame = rest.begin();
    rest.fill(*frame, avatar.rest().positions, avatar.rest().normals, context->axes, 0);
    add_matrices(*frame, identity);
    rest.publish(frame);
    Pose t_pose;
    t_pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    pose(t_pose);
}

void AvatarObject::add_matrices(Frame& frame, std::span<const Mat4> matrices) const {
    auto* out = static_cast<Mat4*>(frame.add_stream(VFIT_STREAM_BONE_MATRIX, VFIT_FORMAT_F32X16,
                                                    static_cast<uint32_t>(matrices.size()), 1));
    for (size_t i = 0; i < matrices.size(); ++i) out[i] = context->axes.matrix_out(matrices[i]);
}

void AvatarObject::set_collider_radii(std::span<const float, kPaperJointCount> measured) {
    avatar.set_collider_radii(measured);
    std::copy(measured.begin(), measured.end(), radii.begin());
}

std::vector<CharacterPart> AvatarObject::parts() const {
    if (!is_body()) return character.parts;
    CharacterPart all;
    all.mesh = "body";
    all.index_count = uint32_t(avatar.rest().indices.size());
    return {all};
}

void AvatarObject::pose(const Pose& pose) {
    Profile::Scope time(context->profile, Stage::avatar);
    Ref<Frame> frame = posed.begin();
    avatar.move(pose);
    const MeshOutput::Vertices vertices =
        posed.add_vertices(*frame, uint32_t(avatar.rest().positions.size()), pose.time_ns);
    SkinTarget target;
    target.positions = vertices.positions;
    target.normals = vertices.normals;
    avatar.skin(target, context->axes, *context->jobs);
    add_matrices(*frame, avatar.skinning_matrices());
    posed.publish(std::move(frame));
}

void AvatarObject::pose_into(const Pose& pose, const SkinTarget& target) {
    Profile::Scope time(context->profile, Stage::avatar);
    avatar.move(pose);
    avatar.skin(target, context->axes, *context->jobs);
}

AvatarObject::SkinBelow AvatarObject::skin_below(std::span<WornGarment* const> outfit) {
    Profile::Scope time(context->profile, Stage::avatar);
    Ref<Frame> frame = posed.begin();
    const OutfitSkin::Drawn skin = outfit_skin_.below(outfit, *context->jobs);
    posed.fill(*frame, skin.positions, skin.normals, context->axes, skin.time_ns);
    add_matrices(*frame, skin.pose);
    return {frame, skin.crossing_pairs};
}

const std::vector<Measurement>& AvatarObject::measures() const {
    if (!is_body())
        fail(VFIT_ERROR_UNSUPPORTED, "a character from a file has no body that could be measured");
    return wearer.measures();
}

}  // namespace vfit::api
