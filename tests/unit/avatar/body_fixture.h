// The baked body, loaded once for all tests of this room.
#pragma once

#include <memory>

#include "avatar/avatar.h"
#include "body/piece_of_surface.h"

namespace vfit {

inline std::shared_ptr<const BodyModel> body_model() {
    static const std::shared_ptr<const BodyModel> model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
    return model;
}

/// Posed in the T-pose.
inline Avatar make_avatar(const AvatarDesc& desc = {}, const Vec2& scale = Vec2(1.0f)) {
    Avatar avatar(body_model(), desc, {}, scale);
    Pose t_pose;
    t_pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    avatar.pose(t_pose, *Jobs::own(0));
    return avatar;
}

}  // namespace vfit
