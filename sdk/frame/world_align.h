// The pose of one camera's world space in that of another one, from people whom both see.
#pragma once

#include <span>

#include "math/types.h"

namespace vfit {

struct WorldPlace {
    Vec3 position{0.0f};
    Quat rotation{1, 0, 0, 0};

    Vec3 point(const Vec3& p) const { return rotation * p + position; }
};

/// From points that both saw at the same times; up (Y) is the same in both. Least squares with weights that
/// fall with the residual (Cauchy). `rms_m`: weighted root mean square residual. Fails with VFIT_ERROR_DATA
/// for fewer than 8 points, points within 0.3 m of their mean, and points that are not finite or over 1 km
/// away.
WorldPlace align_worlds(std::span<const Vec3> here, std::span<const Vec3> there, float& rms_m);

}  // namespace vfit
