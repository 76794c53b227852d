// Where the world space of one camera lies in that of another one: both see the same people.
#pragma once

#include <span>

#include "math/types.h"

namespace vfit {

struct WorldPlace {
    Vec3 position{0.0f};
    Quat rotation{1, 0, 0, 0};

    Vec3 point(const Vec3& p) const { return rotation * p + position; }
};

/// From points that both saw at the same times; up (Y) is the same in both. Least squares, in which points
/// that are wrong count ever less. `rms_m`: what is left, of the points as they count. Fails with
/// VFIT_ERROR_DATA for fewer than 8 points, points that all lie together, and points that are nowhere.
WorldPlace align_worlds(std::span<const Vec3> here, std::span<const Vec3> there, float& rms_m);

}  // namespace vfit
