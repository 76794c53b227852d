// The rigid motion that best carries one set of points to another.
#pragma once

#include <span>

#include "math/types.h"

namespace vfit {

struct RigidMotion {
    Quat rotation{1, 0, 0, 0};
    Vec3 from_center{0.0f}, to_center{0.0f};

    Vec3 point(const Vec3& p) const { return to_center + rotation * (p - from_center); }
    Vec3 direction(const Vec3& v) const { return rotation * v; }
    /// A fraction of its translation and of its rotation.
    RigidMotion part(float fraction) const {
        return {glm::slerp(Quat(1, 0, 0, 0), rotation, fraction), from_center,
                glm::mix(from_center, to_center, fraction)};
    }
};

/// Least squares over the points named by `indices` (at least one); does not allocate.
RigidMotion fit_rigid_motion(std::span<const uint32_t> indices, std::span<const Vec3> from,
                             std::span<const Vec3> to);

}  // namespace vfit
