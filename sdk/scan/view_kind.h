// How a person stands to the camera: views are recognised, nobody has to tell them.
#pragma once

#include <cmath>
#include <cstdint>

#include "math/types.h"

namespace vfit {

enum class ViewKind : uint8_t { kFront, kSide, kOther };
inline constexpr int kViewKinds = 2;  // that are kept

/// How far a person is turned away from the camera to either side, 0 to pi. `ahead`: the way that the hips
/// face, camera space.
inline float turned_rad(const Vec3& ahead) { return std::abs(std::atan2(ahead.x, -ahead.z)); }

/// `slack_rad`: where that is known less well, views are wider by it.
inline ViewKind view_kind_of(const Vec3& ahead, float slack_rad = 0.0f) {
    constexpr float kFrontTo_rad = 0.6f, kSideFrom_rad = 1.05f, kSideTo_rad = 2.1f;
    const float yaw = turned_rad(ahead);
    return yaw <= kFrontTo_rad + slack_rad                                      ? ViewKind::kFront
           : yaw >= kSideFrom_rad - slack_rad && yaw <= kSideTo_rad + slack_rad ? ViewKind::kSide
                                                                                : ViewKind::kOther;
}

}  // namespace vfit
