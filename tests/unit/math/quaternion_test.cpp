#include "math/quaternion.h"

#include <gtest/gtest.h>

#include <random>

namespace vfit {
namespace {

Quat random_rotation(std::mt19937& random) {
    std::normal_distribution<float> n;
    return glm::normalize(Quat(n(random), n(random), n(random), n(random)));
}

Vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<float> n;
    return glm::normalize(Vec3(n(random), n(random), n(random)));
}

TEST(Quaternion, ShortestArcCarriesOneDirectionToTheOtherByTheSmallestAngle) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const Vec3 a = random_direction(random), b = random_direction(random);
        const Quat q = shortest_arc(a * 3.0f, b * 0.1f);
        EXPECT_LT(glm::length(q * a - b), 1e-5f);
        EXPECT_NEAR(angle_of(q), std::acos(glm::clamp(glm::dot(a, b), -1.0f, 1.0f)), 1e-3f);
    }
}

TEST(Quaternion, ShortestArcOfOppositeDirectionsIsAHalfTurn) {
    for (const Vec3& a : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, -1)}) {
        const Quat q = shortest_arc(a, -a);
        EXPECT_LT(glm::length(q * a + a), 1e-5f);
        EXPECT_NEAR(glm::length(q), 1.0f, 1e-5f);
    }
}

TEST(Quaternion, SwingAndTwistMakeTheRotationAndTheTwistKeepsTheAxis) {
    std::mt19937 random(2);
    for (int i = 0; i < 200; ++i) {
        const Quat q = random_rotation(random);
        const Vec3 axis = random_direction(random);
        const SwingTwist s = split_swing_twist(q, axis);
        EXPECT_GT(std::abs(glm::dot(s.swing * s.twist, q)), 1.0f - 1e-5f);
        EXPECT_LT(glm::length(s.twist * axis - axis), 1e-4f);
        EXPECT_NEAR(s.swing.x * axis.x + s.swing.y * axis.y + s.swing.z * axis.z, 0.0f, 1e-4f);
    }
}

TEST(Quaternion, AHalfTurnOfSwingHasNoTwist) {
    const SwingTwist s = split_swing_twist(Quat(0, 0, 1, 0), Vec3(1, 0, 0));
    EXPECT_NEAR(s.twist.w, 1.0f, 1e-6f);
}

TEST(Quaternion, AFractionTurnsByThatShareAboutTheSameAxis) {
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const Quat q = random_rotation(random);
        const Quat third = fraction(q, 1.0f / 3.0f);
        EXPECT_GT(std::abs(glm::dot(third * third * third, q)), 1.0f - 1e-5f);
        EXPECT_NEAR(angle_of(third), angle_of(q) / 3.0f, 1e-3f);
    }
    EXPECT_FLOAT_EQ(fraction(Quat(1, 0, 0, 0), 0.5f).w, 1.0f);
}

TEST(Quaternion, TheSameHemisphereNeverJumpsSign) {
    const Quat reference(0.9f, 0.1f, 0.2f, 0.3f);
    EXPECT_GT(glm::dot(same_hemisphere(-reference, reference), reference), 0.0f);
}

TEST(Quaternion, SmallTurnsByTheirSeriesAgreeWithTheSines) {
    for (float angle = 0.0f; angle < 3.1f; angle += 0.01f) {
        const Vec3 axis = glm::normalize(Vec3(0.3f, -0.5f, 0.8f));
        const Quat q = glm::angleAxis(angle, axis);
        for (const float t : {0.1f, 0.5f, 1.0f, -1.0f}) {
            const Quat part = fraction(q, t), exact = glm::angleAxis(angle * t, axis);
            EXPECT_LT(glm::length(Vec3(part.x - exact.x, part.y - exact.y, part.z - exact.z)), 3e-7f)
                << angle << " " << t;
            EXPECT_NEAR(part.w, exact.w, 3e-7f) << angle << " " << t;
        }
        EXPECT_LT(glm::length(rotation_vector(-q) - axis * angle), 2e-6f) << angle;
        const Quat back = rotation_by(axis * angle);
        EXPECT_LT(std::abs(std::abs(glm::dot(back, q)) - 1.0f), 3e-7f) << angle;
        EXPECT_NEAR(back.w, q.w, 3e-7f) << angle;
    }
}

}  // namespace
}  // namespace vfit
