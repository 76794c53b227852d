// Rotations as three angles: the orders of Unity and of BVH.
#include "math/euler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vfit {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

glm::dmat3 about(int axis, double angle) {
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    return glm::mat3_cast(glm::angleAxis(angle, unit));
}

double error_of(const glm::dmat3& got, const Quat& wanted) {
    const glm::dmat3 r = glm::mat3_cast(glm::normalize(glm::dquat(wanted)));
    double worst = 0;
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(got[c][i] - r[c][i]));
    return worst;
}

double yxz_error(const Quat& q) {
    const EulerAngles a = euler_yxz(q);
    EXPECT_LE(std::abs(a.x), 90.0 * kDegree + 1e-9);
    return error_of(about(1, a.y) * about(0, a.x) * about(2, a.z), q);
}

double zxy_error(const Quat& q, const EulerAngles& a) {
    return error_of(about(2, a.z) * about(0, a.x) * about(1, a.y), q);
}

Quat random_rotation(std::mt19937& bits) {
    std::normal_distribution<float> normal;
    return glm::normalize(Quat(normal(bits), normal(bits), normal(bits), normal(bits)));
}

TEST(Euler, AnglesMeanTheRotation) {
    std::mt19937 bits(1);
    EulerAngles before;
    for (int i = 0; i < 2000; ++i) {
        const Quat q = random_rotation(bits);
        EXPECT_LT(yxz_error(q), 2e-6) << i;
        before = euler_zxy(q, before);
        EXPECT_LT(zxy_error(q, before), 2e-6) << i;
    }
}

TEST(Euler, AnglesMeanTheRotationWhereTwoAxesFallTogether) {
    for (const double middle : {90.0, -90.0, 89.9999, -89.9999})
        for (const double outer : {0.0, 30.0, 170.0, -120.0}) {
            const Quat q(glm::quat_cast(about(1, outer * kDegree) * about(0, middle * kDegree)));
            EXPECT_LT(yxz_error(q), 1e-4) << middle << " " << outer;
            const EulerAngles before{1.0, 0.3, -0.2};
            EXPECT_LT(zxy_error(q, euler_zxy(q, before)), 1e-4) << middle << " " << outer;
        }
}

/// The largest step of an angle, from one frame of a motion to the next.
double largest_step(const EulerAngles& a, const EulerAngles& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

TEST(Euler, NoAngleJumpsWhileAThighIsRaisedPastTheRightAngle) {
    EulerAngles a;
    for (int degree = 1; degree <= 150; ++degree) {
        const Quat q(glm::quat_cast(about(0, -degree * kDegree)));
        const EulerAngles next = euler_zxy(q, a);
        ASSERT_LT(largest_step(a, next), 1.5 * kDegree) << degree;
        a = next;
    }
    EXPECT_NEAR(a.x, -150.0 * kDegree, 1e-5);
}

TEST(Euler, NoAngleJumpsThroughSeveralTurns) {
    EulerAngles a;
    for (int degree = 1; degree <= 900; ++degree) {
        const EulerAngles next = euler_zxy(Quat(glm::quat_cast(about(1, degree * kDegree))), a);
        ASSERT_LT(largest_step(a, next), 1.5 * kDegree) << degree;
        a = next;
    }
    EXPECT_NEAR(a.y, 900.0 * kDegree, 1e-4);
}

TEST(Euler, EachAngleTurnsAboutItsAxis) {
    const Quat x(glm::quat_cast(about(0, 0.4))), y(glm::quat_cast(about(1, 0.5))),
        z(glm::quat_cast(about(2, 0.6)));
    EXPECT_NEAR(euler_yxz(x).x, 0.4, 1e-6);
    EXPECT_NEAR(euler_yxz(y).y, 0.5, 1e-6);
    EXPECT_NEAR(euler_yxz(z).z, 0.6, 1e-6);
    EXPECT_NEAR(euler_zxy(x, {}).x, 0.4, 1e-6);
    EXPECT_NEAR(euler_zxy(y, {}).y, 0.5, 1e-6);
    EXPECT_NEAR(euler_zxy(z, {}).z, 0.6, 1e-6);
}

}  // namespace
}  // namespace vfit
