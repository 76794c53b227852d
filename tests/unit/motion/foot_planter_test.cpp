// Legs whose feet come free and touch down, on the skeleton alone: knees do not snap, feet do not jump, and
// what is shown is soon what is tracked.
#include "motion/foot_planter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/quaternion.h"
#include "motion/joint_limits.h"
#include "motion_support.h"

namespace vfit {
namespace {

constexpr float kFrame = 1.0f / 30.0f;
constexpr int kLegBones[2] = {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG};

struct Scene {
    Skeleton skeleton = testing::test_skeleton();
    RestPose rest{skeleton};
    FootPlanter planter;

    /// Standing on straight legs, the left thigh `swung_rad` ahead of the plumb line; the hips `moved` from
    /// where they stood.
    Pose tracked(float swung_rad, const Vec3& moved = Vec3(0.0f)) const {
        Pose pose;
        pose.hips_position = skeleton.offset[VFIT_BONE_HIPS] + moved;
        pose.rotation[VFIT_BONE_LEFT_UPPER_LEG] = glm::angleAxis(-swung_rad, Vec3(1, 0, 0));
        return pose;
    }
    PosedSkeleton step(Pose pose, bool left) {
        FootPlanter::Seen seen[2];
        seen[0].planted = left;
        seen[1].planted = true;
        planter.apply(skeleton, rest, RangeOfMotion::natural(), seen, kFrame, pose);
        return forward_kinematics(skeleton, pose);
    }
};

float acceleration(const std::vector<PosedSkeleton>& shown, size_t i, int bone) {
    const auto turn = [&](size_t k) {
        const Quat q = shown[k].rotation[size_t(bone)] * glm::conjugate(shown[k - 1].rotation[size_t(bone)]);
        return 2.0f * Vec3(q.x, q.y, q.z) * (q.w < 0 ? -1.0f : 1.0f);
    };
    return glm::length(turn(i + 1) - turn(i)) / (kFrame * kFrame);
}

TEST(FootPlanter, ALegThatComesFreeGoesToItsTrackedPostureWithoutASnapOfTheKnee) {
    Scene scene;
    std::vector<PosedSkeleton> shown;
    // The foot is tracked ever farther ahead while it is held, then it comes free: what a late release looks
    // like.
    for (int i = 0; i < 90; ++i)
        shown.push_back(
            scene.step(scene.tracked(i < 30 ? 0.0f : std::min(0.008f * float(i - 30), 0.2f)), i < 50));
    for (size_t i = 45; i + 1 < shown.size(); ++i)
        for (const int bone : kLegBones)
            EXPECT_LT(acceleration(shown, i, bone), 75.0f) << i << " " << bone_name(bone);
    const Pose tracked = scene.tracked(0.2f);
    const Quat left = shown.back().rotation[VFIT_BONE_LEFT_UPPER_LEG] *
                      glm::conjugate(tracked.rotation[VFIT_BONE_LEFT_UPPER_LEG]);
    EXPECT_LT(angle_of(left), 9.0f * testing::kDeg) << "but for the reserve of a straight leg";
}

TEST(FootPlanter, AFootThatIsTakenForFreeWhileTheHipsJumpStaysWhereItStood) {
    Scene scene;
    PosedSkeleton before, after;
    for (int i = 0; i < 30; ++i) before = scene.step(scene.tracked(0.0f), true);
    after = scene.step(scene.tracked(0.0f, Vec3(0.02f, 0, 0)),
                       false);  // trackers are wrong in everything at once
    EXPECT_LT(glm::distance(after.position[VFIT_BONE_LEFT_FOOT], before.position[VFIT_BONE_LEFT_FOOT]),
              0.004f);
}

TEST(FootPlanter, AFlickerOfTheContactMovesNoKnee) {
    for (const float height_m : {-0.01f, 0.05f}) {  // above the floor, down to which feet settle
        Scene scene;
        std::vector<PosedSkeleton> shown;
        for (int i = 0; i < 70; ++i)
            shown.push_back(
                scene.step(scene.tracked(0.03f, Vec3(0, height_m, 0)), i < 10 || (i > 11 && i != 50)));
        for (size_t i = 8; i + 1 < shown.size(); ++i)
            for (const int bone : kLegBones)
                EXPECT_LT(acceleration(shown, i, bone), 10.0f)
                    << height_m << " " << i << " " << bone_name(bone);
    }
}

TEST(FootPlanter, TheHeelOfAFootThatTheBodyHasPassedRisesBeforeItIsFree) {
    Scene scene;
    std::vector<PosedSkeleton> shown;
    const auto steepest = [&](size_t i) {
        const Quat ankle = glm::conjugate(shown[i].rotation[VFIT_BONE_LEFT_LOWER_LEG]) *
                           shown[i].rotation[VFIT_BONE_LEFT_FOOT];
        Quat limited = ankle;
        limit_ankle(RangeOfMotion::natural(), 0, limited);
        return angle_of(glm::conjugate(limited) * ankle);
    };
    // The body walks on by a good step; the feet lie flat in what is tracked.
    for (int i = 0; i < 60; ++i) {
        Pose pose = scene.tracked(0.0f, Vec3(0, -0.04f, 0.008f * float(std::min(i, 45))));
        shown.push_back(scene.step(pose, i < 50));
    }
    EXPECT_LT(steepest(49), 2.0f * testing::kDeg) << "within its range before it comes free";
    for (size_t i = 20; i + 1 < shown.size(); ++i)
        EXPECT_LT(acceleration(shown, i, VFIT_BONE_LEFT_FOOT), 75.0f) << i;
    const Vec3 sole = shown[49].rotation[VFIT_BONE_LEFT_FOOT] * Vec3(0, 1, 0);
    EXPECT_LT(sole.y, std::cos(5.0f * testing::kDeg)) << "heel up";
}

TEST(FootPlanter, FeetStandStillToAHundredthOfAMillimetre) {
    Scene scene;
    std::vector<PosedSkeleton> shown;
    for (int i = 0; i < 60; ++i) shown.push_back(scene.step(scene.tracked(0.02f), true));
    for (const int bone : kLegBones)
        EXPECT_LT(acceleration(shown, 58, bone), 0.05f) << "a straight knee trembles first";
    EXPECT_LT(glm::distance(shown[59].position[VFIT_BONE_LEFT_FOOT], shown[40].position[VFIT_BONE_LEFT_FOOT]),
              1e-5f);
}

}  // namespace
}  // namespace vfit
