#include "cloth/base/rigid_motion.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

using Matrix4d = glm::dmat4;

/// The rotation R that maximises trace(R^T A), as the eigenvector of Horn's 4x4 matrix (Horn 1987) with the
/// largest eigenvalue, by the power method on the matrix shifted to be positive. Where points lie on a line,
/// any turn about it would do: the smallest is taken.
Quat rotation_of(const Mat3& given) {
    constexpr float kTowardsNone = 1e-5f;  // of the matrix's size
    float size2 = 0.0f;
    for (int i = 0; i < 3; ++i) size2 += glm::dot(given[i], given[i]);
    const Mat3 a = given + Mat3(kTowardsNone * std::sqrt(size2));
    const auto m = [&](int row, int column) {
        return double(a[column][row]);
    };  // sum of to_row * from_column
    double n[4][4] = {{m(0, 0) + m(1, 1) + m(2, 2), m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)},
                      {0, m(0, 0) - m(1, 1) - m(2, 2), m(0, 1) + m(1, 0), m(0, 2) + m(2, 0)},
                      {0, 0, m(1, 1) - m(0, 0) - m(2, 2), m(1, 2) + m(2, 1)},
                      {0, 0, 0, m(2, 2) - m(0, 0) - m(1, 1)}};
    double shift = 0.0;
    for (int i = 0; i < 4; ++i)
        for (int j = i; j < 4; ++j) {
            n[j][i] = n[i][j];
            shift += (i == j ? 1.0 : 2.0) * n[i][j] * n[i][j];
        }
    shift = std::sqrt(shift);  // at least the largest eigenvalue's magnitude
    if (shift == 0.0) return Quat(1, 0, 0, 0);
    Matrix4d power;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) power[j][i] = n[i][j] + (i == j ? shift : 0.0);
    constexpr int kSquarings = 30;  // as good as 2^30 iterations
    for (int k = 0; k < kSquarings; ++k) {
        double most = 0.0;
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) most = std::max(most, std::abs(power[j][i]));
        power = (power / most) * (power / most);
    }
    // Start off every axis, so that no exact half turn stands square to it.
    const glm::dvec4 q = glm::normalize(power * glm::dvec4(0.9, 0.25, 0.27, 0.23));
    return Quat(float(q[0]), float(q[1]), float(q[2]), float(q[3]));
}

}  // namespace

RigidMotion fit_rigid_motion(std::span<const uint32_t> indices, std::span<const Vec3> from,
                             std::span<const Vec3> to) {
    RigidMotion motion;
    for (uint32_t i : indices) {
        motion.from_center += from[i] / float(indices.size());
        motion.to_center += to[i] / float(indices.size());
    }
    Mat3 covariance(0.0f);
    for (uint32_t i : indices)
        covariance += glm::outerProduct(to[i] - motion.to_center, from[i] - motion.from_center);
    motion.rotation = rotation_of(covariance);
    return motion;
}

}  // namespace vfit
