// The root's height and the pelvis' roll from what both feet say.
#include "motion/root_height.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion_support.h"

namespace vfit {
namespace {

constexpr float kFrame = 1.0f / 30.0f;
constexpr bool kBoth[2] = {true, true}, kRight[2] = {false, true}, kNone[2] = {false, false};

/// A left leg, hanging plumb, its knee bent.
Leg bent_leg(const Skeleton& skeleton, const RestPose& rest, float bend_rad) {
    Pose pose;
    pose.hips_position = skeleton.offset[VFIT_BONE_HIPS];
    pose.rotation[VFIT_BONE_LEFT_UPPER_LEG] = glm::angleAxis(-0.5f * bend_rad, Vec3(1, 0, 0));
    pose.rotation[VFIT_BONE_LEFT_LOWER_LEG] = glm::angleAxis(bend_rad, Vec3(1, 0, 0));
    return Leg(0, rest, forward_kinematics(skeleton, pose));
}

TEST(HeightVote, AsksForTheHeightAtWhichTheLegIsAsLongAsItWasTracked) {
    const Skeleton skeleton = testing::test_skeleton();
    const RestPose rest(skeleton);
    const Leg leg = bent_leg(skeleton, rest, 0.6f);
    const Vec3 target = leg.ankle + Vec3(0.05f, -0.03f, 0.1f);
    const HeightVote vote = standing_vote(leg, target);
    EXPECT_NEAR(glm::distance(leg.hip + Vec3(0, vote.rise_m, 0), target), leg.length(), 1e-5f);
}

TEST(HeightVote, IsAsSureAsAKneeSaysALength) {
    const Skeleton skeleton = testing::test_skeleton();
    const RestPose rest(skeleton);
    const auto length = [&](float bend_rad) { return bent_leg(skeleton, rest, bend_rad).length(); };
    const auto sd = [&](float bend_rad) {
        const Leg leg = bent_leg(skeleton, rest, bend_rad);
        return standing_vote(leg, leg.ankle).sd_m;
    };
    EXPECT_LT(sd(0.02f), 0.006f);
    for (const float bend : {0.5f, 1.0f, 1.5f})
        EXPECT_NEAR(sd(bend), 0.09f * std::abs(length(bend + 0.01f) - length(bend - 0.01f)) / 0.02f, 0.001f)
            << bend;
}

TEST(RootHeight, FollowsTheStraightLegAndLeavesTheBentOneItsKnee) {
    const HeightVote votes[2] = {{0.02f, 0.03f}, {0.0f, 0.004f}};
    RootHeight height;
    height.update(votes, kBoth, kFrame);
    const float left = height.lift_m() + 0.5f * height.slope_m();
    const float right = height.lift_m() - 0.5f * height.slope_m();
    EXPECT_NEAR(right, 0.0f, 0.001f);
    EXPECT_GT(left, 0.005f);
    EXPECT_LT(left, 0.015f) << "the rest is the knee's";
}

TEST(RootHeight, IsNotMovedByAFreeFootWhileTheOtherStands) {
    RootHeight height;
    HeightVote votes[2] = {{0.0f, 0.005f}, {0.0f, 0.005f}};
    for (int i = 0; i < 10; ++i) height.update(votes, kBoth, kFrame);
    for (int i = 0; i < 30; ++i) {
        votes[0] = free_vote(i % 2 ? 0.3f : -0.2f);  // a leg that the tracker lost
        height.update(votes, kRight, kFrame);
        EXPECT_NEAR(height.lift_m(), 0.0f, 1e-4f);
        EXPECT_NEAR(height.slope_m(), 0.0f, 1e-4f);
    }
}

TEST(RootHeight, RisesWithBothFeetInAJump) {
    RootHeight height;
    const HeightVote stand[2] = {{0.0f, 0.005f}, {0.0f, 0.005f}};
    for (int i = 0; i < 10; ++i) height.update(stand, kBoth, kFrame);
    const HeightVote air[2] = {free_vote(0.2f), free_vote(0.2f)};
    for (int i = 0; i < 20; ++i) height.update(air, kNone, kFrame);
    EXPECT_NEAR(height.lift_m(), 0.2f, 0.01f);
    const HeightVote half[2] = {free_vote(0.2f), HeightVote()};  // one of them is not seen
    for (int i = 0; i < 20; ++i) height.update(half, kNone, kFrame);
    EXPECT_NEAR(height.lift_m(), 0.2f, 0.01f);
}

TEST(RootHeight, GoesOnWithTheFootThatStandsOnWithoutAJump) {
    RootHeight height;
    HeightVote votes[2] = {{0.03f, 0.005f}, {0.0f, 0.005f}};
    for (int i = 0; i < 10; ++i) height.update(votes, kBoth, kFrame);
    float lift = height.lift_m(), slope = height.slope_m();
    for (int i = 0; i < 40; ++i) {
        votes[0] = free_vote(0.0f);
        votes[1].rise_m += 0.002f;  // the root sinks meanwhile
        height.update(votes, kRight, kFrame);
        if (i == 0) {
            EXPECT_NEAR(height.lift_m(), lift + 0.002f, 1e-4f);
            EXPECT_NEAR(height.slope_m(), slope, 1e-4f);
        }
        EXPECT_LT(std::abs(height.lift_m() - lift), 0.006f);
        lift = height.lift_m(), slope = height.slope_m();
    }
    EXPECT_NEAR(lift, votes[1].rise_m, 0.001f);
    EXPECT_NEAR(slope, 0.0f, 0.001f);
}

}  // namespace
}  // namespace vfit
