#include "math/euler.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vfit {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Below this cosine of the middle angle the outer two turn about one axis: rounding of the quaternion (1e-7)
// would move each of them by more than 0.06 degrees.
constexpr double kMinCosine = 1e-4;

/// Rows and columns of the rotation matrix.
struct Rows {
    explicit Rows(const Quat& q) : m(glm::mat3_cast(glm::normalize(glm::dquat(q)))) {}
    double at(int row, int column) const { return m[column][row]; }
    glm::dmat3 m;
};

double next_to(double angle, double before) { return angle - kTurn * std::round((angle - before) / kTurn); }

double way(const EulerAngles& a, const EulerAngles& b) {
    return std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z);
}

EulerAngles next_to(const EulerAngles& a, const EulerAngles& before) {
    return {next_to(a.x, before.x), next_to(a.y, before.y), next_to(a.z, before.z)};
}

}  // namespace

EulerAngles euler_yxz(const Quat& q) {
    const Rows r(q);
    const double cosine = std::hypot(r.at(0, 2), r.at(2, 2));
    const double x = std::atan2(-r.at(1, 2), cosine);
    if (cosine < kMinCosine) return {x, std::atan2(-r.at(2, 0), r.at(0, 0)), 0.0};
    return {x, std::atan2(r.at(0, 2), r.at(2, 2)), std::atan2(r.at(1, 0), r.at(1, 1))};
}

EulerAngles euler_zxy(const Quat& q, const EulerAngles& before) {
    const Rows r(q);
    const double cosine = std::hypot(r.at(0, 1), r.at(1, 1));
    const double x = std::atan2(r.at(2, 1), cosine);
    if (cosine < kMinCosine) {
        // y stays, z takes the rest: R depends on z + y alone where x is a quarter turn, on z - y where it is
        // minus one.
        const double both = std::atan2(r.at(1, 0), r.at(0, 0));
        const EulerAngles locked{x, before.y, x > 0.0 ? both - before.y : both + before.y};
        return next_to(locked, before);
    }
    const EulerAngles one{x, std::atan2(-r.at(2, 0), r.at(2, 2)), std::atan2(-r.at(0, 1), r.at(1, 1))};
    const EulerAngles a = next_to(one, before);
    const EulerAngles b = next_to({kTurn / 2 - one.x, one.y + kTurn / 2, one.z + kTurn / 2}, before);
    return way(a, before) <= way(b, before) ? a : b;
}

}  // namespace vfit
