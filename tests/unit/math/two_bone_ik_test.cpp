// Two-bone inverse kinematics: exact in reach, finite beyond it.
#include "math/two_bone_ik.h"

#include <gtest/gtest.h>

#include "math/finite.h"
#include "math/random.h"

namespace vfit {
namespace {

struct Trial {
    Vec3 root, goal, pole;
    float upper, lower, distance;
};

Trial random_trial(Random& random, float least_reach, float most_reach) {
    Trial t;
    const auto v = [&random] {
        return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    };
    t.root = 2.0f * v();
    t.upper = random.between(0.2f, 0.6f);
    t.lower = random.between(0.2f, 0.6f);
    const float least = std::abs(t.upper - t.lower) + 1e-3f, most = t.upper + t.lower;
    t.distance = least + (most - least) * random.between(least_reach, most_reach);
    t.goal = t.root + t.distance * glm::normalize(v() + Vec3(0, 0, 1e-3f));
    t.pole = v();
    return t;
}

TEST(TwoBoneIk, ReachesEveryReachableGoalWithinATenthOfAMillimetre) {
    Random random(7);
    for (int i = 0; i < 20000; ++i) {
        const Trial t = random_trial(random, 0.0f, 0.998f);
        const TwoBoneSolution s = solve_two_bone(t.root, t.upper, t.lower, t.goal, t.pole, 0.001f);
        ASSERT_LT(glm::length(s.end - t.goal), 1e-4f);
        ASSERT_NEAR(glm::length(s.middle - t.root), t.upper, 1e-4f);
        ASSERT_NEAR(glm::length(s.end - s.middle), t.lower, 1e-4f);
    }
}

TEST(TwoBoneIk, BendsTowardsThePole) {
    Random random(8);
    for (int i = 0; i < 2000; ++i) {
        const Trial t = random_trial(random, 0.1f, 0.9f);
        const TwoBoneSolution s = solve_two_bone(t.root, t.upper, t.lower, t.goal, t.pole, 0.0f);
        const Vec3 n = glm::normalize(t.goal - t.root);
        const Vec3 side = s.middle - t.root - glm::dot(s.middle - t.root, n) * n;
        const Vec3 wanted = t.pole - glm::dot(t.pole, n) * n;
        if (glm::length(side) < 0.01f || glm::length(wanted) < 0.05f) continue;
        ASSERT_GT(glm::dot(glm::normalize(side), glm::normalize(wanted)), 0.999f);
    }
}

TEST(TwoBoneIk, StaysFiniteAndPointsAtGoalsBeyondReach) {
    Random random(9);
    for (int i = 0; i < 2000; ++i) {
        const Trial t = random_trial(random, 1.0f, 5.0f);
        const TwoBoneSolution s = solve_two_bone(t.root, t.upper, t.lower, t.goal, t.pole, 0.002f);
        ASSERT_TRUE(finite(s.middle) && finite(s.end));
        ASSERT_LE(glm::length(s.end - t.root), t.upper + t.lower + 1e-5f);
        ASSERT_GT(glm::dot(glm::normalize(s.end - t.root), glm::normalize(t.goal - t.root)), 0.9999f);
    }
    for (const Vec3& goal : {Vec3(0), Vec3(1e-9f, 0, 0), Vec3(0, 1e6f, 0)})
        for (const Vec3& pole : {Vec3(0), Vec3(0, 1, 0)}) {
            const TwoBoneSolution s = solve_two_bone(Vec3(0), 0.4f, 0.4f, goal, pole, 0.002f);
            EXPECT_TRUE(finite(s.middle) && finite(s.end));
        }
}

TEST(TwoBoneIk, EasesIntoFullExtensionWithoutAKneeSnap) {
    // Hard: near full extension the knee moves without bound against the goal. Eased: it does not.
    const auto fastest_knee = [](float softness) {
        float fastest = 0;
        Vec3 before = solve_two_bone(Vec3(0), 0.4f, 0.4f, {0, -0.79f, 0}, {0, 0, 1}, softness).middle;
        for (int i = 1; i <= 2000; ++i) {
            const Vec3 goal(0, -0.79f - 1e-5f * static_cast<float>(i), 0);
            const Vec3 knee = solve_two_bone(Vec3(0), 0.4f, 0.4f, goal, {0, 0, 1}, softness).middle;
            fastest = std::max(fastest, glm::length(knee - before) / 1e-5f);
            before = knee;
        }
        return fastest;
    };
    EXPECT_LT(fastest_knee(0.002f), 0.5f * fastest_knee(0.0f));
}

}  // namespace
}  // namespace vfit
