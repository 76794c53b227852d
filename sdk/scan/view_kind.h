// How a person stands to the camera: views are recognised, nobody has to tell them.
#pragma once

#include <cmath>
#include <cstdint>

#include "frame/camera.h"
#include "math/types.h"

namespace vfit {

enum class ViewKind : uint8_t { kFront, kSide, kOther };
inline constexpr int kViewKinds = 2;  // that are kept

/// Radians that a person is turned to their left from facing the camera, however that is tilted or rolled.
/// `ahead`: the way that the hips face, camera space.
inline float facing_rad(const Camera& camera, const Vec3& ahead) {
    const Vec3 level = Mat3(camera.world_from_camera()) * ahead;
    return std::atan2(level.x, level.z);
}

/// By that angle. `slack_rad`: where it is known less well, views are wider by it.
inline ViewKind view_kind_of(float facing_rad, float slack_rad = 0.0f) {
    constexpr float kFrontTo_rad = 0.6f, kSideFrom_rad = 1.05f, kSideTo_rad = 2.1f;
    const float yaw = std::abs(facing_rad);
    return yaw <= kFrontTo_rad + slack_rad                                      ? ViewKind::kFront
           : yaw >= kSideFrom_rad - slack_rad && yaw <= kSideTo_rad + slack_rad ? ViewKind::kSide
                                                                                : ViewKind::kOther;
}

}  // namespace vfit
