// The object behind vfit_avatar.
#pragma once

#include "api/mesh_frame.h"
#include "avatar/avatar.h"
#include "measure/measurement.h"

namespace vfit::api {

struct AvatarObject : ContextChild {
    static constexpr Kind kKind = Kind::avatar;
    AvatarObject(Ref<Context> owner, const AvatarDesc& desc, std::span<const float> shape, const Vec2& scale);

    Avatar avatar;
    const vfit_sex sex;
    MeshOutput posed, rest;
    float relative_sigma = 0.0f;  // of measures of its body as the person's whom it was made of; 0: unknown

    /// Poses the avatar and publishes its mesh; nothing changes where it fails.
    void pose(const Pose& pose);
    /// Poses the avatar and writes its skin into the host's memory; the published mesh stays as it was.
    void pose_into(const Pose& pose, const SkinTarget& target);
    /// Tape measures of its own body; taken when first asked for.
    const std::vector<Measurement>& measures();

private:
    void add_matrices(Frame& frame, std::span<const Mat4> matrices) const;
    std::mutex measures_mutex_;
    std::vector<Measurement> measures_;
};

}  // namespace vfit::api
