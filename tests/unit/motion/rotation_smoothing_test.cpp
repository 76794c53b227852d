// Asymptotic rotation smoothing: Eq. 10 at 30 Hz, the same rate in time at any other.
#include "motion/rotation_smoothing.h"

#include <gtest/gtest.h>

#include "math/quaternion.h"
#include "motion_support.h"

namespace vfit {
namespace {

/// Fraction of a turn that is slow enough for every bone.
float left_after(float seconds, int rate_hz, float divisor) {
    RotationSmoother smoother;
    std::array<Quat, kBoneCount> world;
    world.fill(Quat(1, 0, 0, 0));
    smoother.apply(world, divisor, 0.0f);
    constexpr float kTurn = 0.2f;
    const Quat target = glm::angleAxis(kTurn, glm::normalize(Vec3(1, 2, 3)));
    for (int i = 0; i < static_cast<int>(std::lround(seconds * static_cast<float>(rate_hz))); ++i) {
        world.fill(target);
        smoother.apply(world, divisor, 1.0f / static_cast<float>(rate_hz));
    }
    return angle_of(target * glm::conjugate(world[VFIT_BONE_HEAD])) / kTurn;
}

TEST(RotationSmoothing, TurnsTheKthPartOfTheWayEachFrameOf30Hz) {
    EXPECT_NEAR(left_after(1.0f / 30, 30, 2.0f), 0.5f, 1e-3f);
    EXPECT_NEAR(left_after(1.0f / 30, 30, 4.0f), 0.75f, 1e-3f);
    EXPECT_NEAR(left_after(3.0f / 30, 30, 2.0f), 0.125f, 1e-3f);
}

TEST(RotationSmoothing, ConvergesAtTheSameRateAt30And120And600Hz) {
    for (float k : {2.0f, 4.0f})
        for (float seconds : {0.1f, 0.2f}) {
            const float at_30 = left_after(seconds, 30, k);
            EXPECT_NEAR(left_after(seconds, 120, k), at_30, 3e-3f);
            EXPECT_NEAR(left_after(seconds, 600, k), at_30, 3e-3f);
        }
}

TEST(RotationSmoothing, PassesThroughWithADivisorOfOneAndTakesTheShortWay) {
    EXPECT_NEAR(left_after(1.0f / 30, 30, 1.0f), 0.0f, 5e-3f);
    RotationSmoother smoother;
    std::array<Quat, kBoneCount> world;
    world.fill(glm::angleAxis(0.1f, Vec3(0, 1, 0)));
    smoother.apply(world, 2.0f, 1.0f / 30);
    world.fill(-glm::angleAxis(0.3f, Vec3(0, 1, 0)));  // the same rotation, other sign
    smoother.apply(world, 2.0f, 1.0f / 30);
    EXPECT_NEAR(angle_of(world[0]), 0.2f, 1e-4f);
}

TEST(RotationSmoothing, TurnsNoFasterThanPeopleDo) {
    RotationSmoother smoother;
    std::array<Quat, kBoneCount> world;
    world.fill(Quat(1, 0, 0, 0));
    smoother.apply(world, 2.0f, 0.0f);
    // An arm that leaps to the other side: half of the way in a frame would be 47 rad/s.
    const Quat target = glm::angleAxis(kPi - 0.01f, Vec3(0, 1, 0));
    world.fill(target);
    smoother.apply(world, 2.0f, 1.0f / 30);
    EXPECT_NEAR(angle_of(world[VFIT_BONE_LEFT_UPPER_ARM]), 16.0f / 30, 1e-3f);
    EXPECT_NEAR(angle_of(world[VFIT_BONE_CHEST]), 8.0f / 30, 1e-3f);
    for (int i = 0; i < 60; ++i) {
        world.fill(target);
        smoother.apply(world, 2.0f, 1.0f / 30);
    }
    for (const Quat& q : world) EXPECT_LT(angle_of(target * glm::conjugate(q)), 1e-3f);
}

}  // namespace
}  // namespace vfit
