#include "api/avatar_object.h"

#include "avatar/avatar_measures.h"

namespace vfit::api {

AvatarObject::AvatarObject(Ref<Context> owner, const AvatarDesc& desc, std::span<const float> shape,
                           const Vec2& scale)
    : ContextChild(std::move(owner)),
      avatar(context->body_model(), desc, shape, scale),
      sex(desc.sex),
      posed(*context),
      rest(*context) {
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
    fill(rest, *frame, avatar.rest().positions, avatar.rest().normals, identity, 0);
    rest.publish(frame);
    Pose t_pose;
    t_pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    pose(t_pose);
}

void AvatarObject::fill(MeshOutput& output, Frame& frame, std::span<const Vec3> positions,
                        std::span<const Vec3> normals, std::span<const Mat4> matrices, int64_t time_ns) const {
    output.fill(frame, positions, normals, context->axes, time_ns);
    auto* out = static_cast<Mat4*>(frame.add_stream(VFIT_STREAM_BONE_MATRIX, VFIT_FORMAT_F32X16,
                                                    static_cast<uint32_t>(matrices.size()), 1));
    for (size_t i = 0; i < matrices.size(); ++i) out[i] = context->axes.matrix_out(matrices[i]);
}

void AvatarObject::pose(const Pose& pose) {
    Profile::Scope time(context->profile, Stage::avatar);
    Ref<Frame> frame = posed.begin();
    avatar.pose(pose, *context->jobs);
    fill(posed, *frame, avatar.positions(), avatar.normals(), avatar.skinning_matrices(), pose.time_ns);
    posed.publish(std::move(frame));
}

const std::vector<Measurement>& AvatarObject::measures() {
    std::lock_guard lock(measures_mutex_);
    if (measures_.empty()) measures_ = measure_avatar(avatar, sex);
    return measures_;
}

}  // namespace vfit::api
