// Rotations from positions: a known pose comes back, whatever joints a source has.
#include <gtest/gtest.h>

#include "math/finite.h"
#include "math/quaternion.h"
#include "motion_support.h"

namespace vfit {
namespace {

using testing::frame_ns;
using testing::kAllOff;

Pose recovered(const Skeleton& skeleton, const Body& body) {
    MotionSettings settings;
    settings.flags = kAllOff;
    Motion motion(settings);
    motion.bind(skeleton);
    EXPECT_TRUE(motion.step(&body, body.time_ns));
    return motion.pose();
}

TEST(BoneRotations, ReproduceTheJointsOfRandomPosesWithinAMillimetre) {
    const Skeleton skeleton = testing::test_skeleton();
    testing::RandomPose random(11);
    for (int i = 0; i < 500; ++i) {
        const Pose pose = random.next(skeleton);
        const Pose found = recovered(skeleton, testing::joints_of(skeleton, pose, 0));
        ASSERT_LT(testing::largest_joint_error(skeleton, pose, found), 1e-3f) << "pose " << i;
    }
}

TEST(BoneRotations, ReproduceBendAndTwistOfBentLimbs) {
    const Skeleton skeleton = testing::test_skeleton();
    testing::RandomPose random(12);
    for (int i = 0; i < 300; ++i) {
        const Pose pose = random.next(skeleton);
        const Pose found = recovered(skeleton, testing::joints_of(skeleton, pose, 0));
        const PosedSkeleton a = forward_kinematics(skeleton, pose), b = forward_kinematics(skeleton, found);
        for (int bone : {VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_LEFT_UPPER_LEG,
                         VFIT_BONE_RIGHT_UPPER_LEG}) {
            const Quat bend = pose.rotation[size_t(bone) + 1];
            if (angle_of(bend) < 25 * testing::kDeg) continue;
            // The limbs of this skeleton slope by up to 3 degrees against each other in the T-pose.
            ASSERT_LT(angle_of(a.rotation[size_t(bone)] * glm::conjugate(b.rotation[size_t(bone)])),
                      10 * testing::kDeg)
                << "pose " << i << " " << bone_name(bone);
        }
    }
}

TEST(BoneRotations, FindATPoseAsIdentitiesAndATurnedPersonAsTurnedHips) {
    const Skeleton skeleton = testing::test_skeleton();
    for (float yaw : {0.0f, 90.0f, 180.0f, -120.0f}) {
        Pose pose;
        pose.hips_position = {0, 0.96f, -2};
        pose.rotation[VFIT_BONE_HIPS] = glm::angleAxis(yaw * testing::kDeg, Vec3(0, 1, 0));
        testing::stand_on_floor(skeleton, pose);
        const Pose found = recovered(skeleton, testing::joints_of(skeleton, pose, 0));
        for (size_t b = 0; b < size_t(kBoneCount); ++b)
            EXPECT_LT(angle_of(found.rotation[b] * glm::conjugate(pose.rotation[b])), 2 * testing::kDeg)
                << bone_name(int(b)) << " at " << yaw;
    }
}

TEST(BoneRotations, ManageWithTheFifteenJointsOfThePaper) {
    const Skeleton skeleton = testing::test_skeleton();
    testing::RandomPose random(13);
    for (int i = 0; i < 100; ++i) {
        const Pose pose = random.next(skeleton);
        Body body = testing::joints_of(skeleton, pose, 0);
        for (size_t j = kPaperJointCount; j < size_t(kJointCount); ++j) body.joints[j] = Joint();
        body.joints[VFIT_JOINT_TORSO] = Joint();
        const Pose found = recovered(skeleton, body);
        const Body again = testing::joints_of(skeleton, found, 0);
        for (int j : {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_LEFT_KNEE,
                      VFIT_JOINT_RIGHT_FOOT, VFIT_JOINT_NECK})
            ASSERT_LT(glm::length(again.at(j) - body.at(j)), 1e-3f) << joint_name(j);
    }
}

TEST(BoneRotations, PlaceAPersonSeenToTheWaistOnly) {
    const Skeleton skeleton = testing::test_skeleton();
    Body body = testing::joints_of(skeleton, Pose(), 0);
    for (int j = VFIT_JOINT_LEFT_HIP; j <= VFIT_JOINT_RIGHT_FOOT; ++j) body.joints[size_t(j)] = Joint();
    for (int j :
         {VFIT_JOINT_PELVIS, VFIT_JOINT_TORSO, VFIT_JOINT_NECK, VFIT_JOINT_LEFT_TOES, VFIT_JOINT_RIGHT_TOES})
        body.joints[size_t(j)] = Joint();
    const Pose found = recovered(skeleton, body);
    EXPECT_TRUE(finite(found.hips_position));
    for (const Quat& q : found.rotation) EXPECT_TRUE(finite(q));
    EXPECT_LT(angle_of(found.rotation[VFIT_BONE_HIPS]), 3 * testing::kDeg);
}

TEST(BoneRotations, TakeTheRotationsThatJointsCarry) {
    const Skeleton skeleton = testing::test_skeleton();
    testing::RandomPose random(14);
    const Pose pose = random.next(skeleton);
    const PosedSkeleton posed = forward_kinematics(skeleton, pose);
    Body body = testing::joints_of(skeleton, pose, 0);
    const Quat twisted = posed.rotation[VFIT_BONE_LEFT_LOWER_ARM] * glm::angleAxis(0.7f, Vec3(1, 0, 0));
    body.joints[VFIT_JOINT_LEFT_ELBOW].rotation = twisted;
    body.joints[VFIT_JOINT_LEFT_ELBOW].has_rotation = true;
    const PosedSkeleton found = forward_kinematics(skeleton, recovered(skeleton, body));
    EXPECT_LT(angle_of(found.rotation[VFIT_BONE_LEFT_LOWER_ARM] * glm::conjugate(twisted)), 1e-3f);
}

TEST(BoneRotations, HoldThePlaneOfAnArmThatIsStretchedOut) {
    // The arm straightens with noise: its twist must not follow the noise round.
    Skeleton skeleton = testing::test_skeleton();
    skeleton.offset[VFIT_BONE_LEFT_LOWER_ARM] = {0.28f, 0, 0};
    skeleton.offset[VFIT_BONE_LEFT_HAND] = {0.25f, 0, 0};
    MotionSettings settings;
    settings.flags = kAllOff;
    Motion motion(settings);
    motion.bind(skeleton);
    testing::RandomPose random(15);
    Quat bent(1, 0, 0, 0);
    for (int f = 0; f < 200; ++f) {
        Pose pose;
        testing::stand_on_floor(skeleton, pose);
        const float flexion = f < 30 ? 60.0f - 2.0f * static_cast<float>(f) : 0.0f;
        pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = glm::angleAxis(-40 * testing::kDeg, Vec3(1, 0, 0));
        pose.rotation[VFIT_BONE_LEFT_LOWER_ARM] = glm::angleAxis(-flexion * testing::kDeg, Vec3(0, 1, 0));
        Body body = testing::joints_of(skeleton, pose, frame_ns(f));
        if (f >= 30)
            for (int j : {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_WRIST})
                body.joints[size_t(j)].position +=
                    0.003f * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        motion.step(&body, body.time_ns);
        const Quat now = motion.pose().rotation[VFIT_BONE_LEFT_UPPER_ARM];
        if (f == 20) bent = now;
        if (f > 20) {
            ASSERT_LT(angle_of(now * glm::conjugate(bent)), 20 * testing::kDeg) << f;
        }
    }
}

/// The left arm hangs, rolled about itself and bent, of bones that run straight in the T-pose.
Pose hanging_arm(const Skeleton& skeleton, float roll_deg, float flexion_deg) {
    Pose pose;
    testing::stand_on_floor(skeleton, pose);
    pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = glm::angleAxis(-80 * testing::kDeg, Vec3(0, 0, 1)) *
                                              glm::angleAxis(roll_deg * testing::kDeg, Vec3(1, 0, 0));
    pose.rotation[VFIT_BONE_LEFT_LOWER_ARM] = glm::angleAxis(-flexion_deg * testing::kDeg, Vec3(0, 1, 0));
    return pose;
}

Skeleton with_straight_arm() {
    Skeleton skeleton = testing::test_skeleton();
    skeleton.offset[VFIT_BONE_LEFT_LOWER_ARM] = {0.28f, 0, 0};
    skeleton.offset[VFIT_BONE_LEFT_HAND] = {0.25f, 0, 0};
    return skeleton;
}

/// How far the upper arm turns about its own axis, its swing taken out.
float roll_between(const Quat& from, const Quat& to) {
    const Vec3 axis(1, 0, 0);
    return angle_of(split_swing_twist(glm::conjugate(from) * to, axis).twist);
}

TEST(BoneRotations, ANearlyStraightArmDoesNotFlipItsRoll) {
    // As a depth sensor sees an arm that hangs: the noise bends it to every side.
    const Skeleton skeleton = with_straight_arm();
    MotionSettings settings;
    settings.flags = kAllOff;
    Motion motion(settings);
    motion.bind(skeleton);
    testing::RandomPose random(16);
    Quat before(1, 0, 0, 0);
    for (int f = 0; f < 600; ++f) {
        Body body = testing::joints_of(skeleton, hanging_arm(skeleton, 0.0f, 12.0f), frame_ns(f));
        for (const int j : {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_WRIST})
            body.joints[size_t(j)].position +=
                0.045f * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        motion.step(&body, body.time_ns);
        const Quat now = motion.pose().rotation[VFIT_BONE_LEFT_UPPER_ARM];
        // 12 rad/s, and what the swing of noisy joints adds.
        if (f > 0) {
            ASSERT_LT(roll_between(before, now), 40 * testing::kDeg) << f;
        }
        before = now;
    }
}

TEST(BoneRotations, ABentArmFollowsItsRollWithinAQuarterOfASecond) {
    const Skeleton skeleton = with_straight_arm();
    MotionSettings settings;
    settings.flags = kAllOff;
    Motion motion(settings);
    motion.bind(skeleton);
    const auto turned = [&](float roll_deg, int frame) {
        const Pose pose = hanging_arm(skeleton, roll_deg, 80.0f);
        const Body body = testing::joints_of(skeleton, pose, frame_ns(frame));
        motion.step(&body, body.time_ns);
        return roll_between(pose.rotation[VFIT_BONE_LEFT_UPPER_ARM],
                            motion.pose().rotation[VFIT_BONE_LEFT_UPPER_ARM]);
    };
    for (int f = 0; f < 30; ++f) turned(0.0f, f);
    float off = 0.0f;
    for (int f = 30; f < 38; ++f) off = turned(60.0f, f);
    EXPECT_LT(off, 8 * testing::kDeg);
}

}  // namespace
}  // namespace vfit
