// Joint limits: what is natural passes untouched, what is not is brought to the edge of the range.
#include "motion/joint_limits.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "math/quaternion.h"
#include "motion_support.h"

namespace vfit {
namespace {

using testing::kDeg;

const Vec3 kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);

struct Limits : ::testing::Test {
    RestPose rest{testing::test_skeleton()};
    bool planted[2] = {false, false};
    Quat limited(int bone, const Quat& q) {
        BoneRotations local;
        local.fill(Quat(1, 0, 0, 0));
        local[static_cast<size_t>(bone)] = q;
        apply_joint_limits(rest, planted, local);
        return local[static_cast<size_t>(bone)];
    }
    float angle_after(int bone, float degrees, const Vec3& axis) {
        return angle_of(limited(bone, glm::angleAxis(degrees * kDeg, axis))) / kDeg;
    }
};

TEST_F(Limits, LeavesNaturalPosesBitForBit) {
    testing::RandomPose random(3);
    for (int i = 0; i < 1000; ++i) {
        const Pose pose = random.next(testing::test_skeleton());
        BoneRotations local = pose.rotation;
        apply_joint_limits(rest, planted, local);
        for (size_t b = 0; b < local.size(); ++b) ASSERT_EQ(local[b], pose.rotation[b]) << bone_name(int(b));
    }
}

TEST_F(Limits, HoldKneesBetweenStraightAnd145Degrees) {
    for (int knee : {VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG}) {
        EXPECT_NEAR(angle_after(knee, 100, kX), 100, 0.01f);
        EXPECT_NEAR(angle_after(knee, 170, kX), 145, 3.0f);  // the T-pose is bent by 1.4 degrees itself
        EXPECT_LT(angle_after(knee, -40, kX), 3.0f);         // never forwards
        EXPECT_NEAR(angle_after(knee, 30, kZ), 10, 3.0f);    // hardly out of its plane
        EXPECT_NEAR(angle_after(knee, 30, kY), 10, 1.0f);    // nor about its axis
    }
}

TEST_F(Limits, AreDataThatAHostMayReplace) {
    const RangeOfMotion& natural = RangeOfMotion::natural();
    EXPECT_EQ(natural.knee_flexion.most_deg, 145.0f);
    EXPECT_EQ(natural.wrist_radial.least_deg, -40.0f);
    const RangeOfMotion stiff =
        RangeOfMotion::read(R"({"knee": {"flexion": 60}, "neck": {"extension": 10}})", natural);
    EXPECT_EQ(stiff.knee_flexion.most_deg, 60.0f);
    EXPECT_EQ(stiff.neck_flexion.least_deg, -10.0f);
    EXPECT_EQ(stiff.neck_flexion.most_deg, natural.neck_flexion.most_deg);
    BoneRotations local;
    local.fill(Quat(1, 0, 0, 0));
    local[VFIT_BONE_LEFT_LOWER_LEG] = glm::angleAxis(100 * kDeg, kX);
    apply_joint_limits(rest, planted, local, stiff);
    EXPECT_NEAR(angle_of(local[VFIT_BONE_LEFT_LOWER_LEG]) / kDeg, 60.0f, 3.0f);
    for (const char* bad :
         {"", "[]", "{", R"({"knee": 3})", R"({"knee": {"flexion": "far"}})", R"({"knee": {"flexion": 200}})",
          R"({"knee": {"flexion": -1}})", R"({"knee": {"bend": 3}})", R"({"tail": {"flexion": 3}})"})
        try {
            RangeOfMotion::read(bad, natural);
            ADD_FAILURE() << "accepted " << bad;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_DATA) << bad;
        }
}

TEST_F(Limits, HoldElbowsInTheirPlaneOnBothSides) {
    for (float side : {1.0f, -1.0f}) {
        const int elbow = side > 0 ? VFIT_BONE_LEFT_LOWER_ARM : VFIT_BONE_RIGHT_LOWER_ARM;
        EXPECT_NEAR(angle_after(elbow, -side * 120, kY), 120, 0.01f);
        EXPECT_NEAR(angle_after(elbow, -side * 175, kY), 150, 3.0f);
        EXPECT_NEAR(angle_after(elbow, side * 60, kY), 5, 3.0f);
        EXPECT_NEAR(angle_after(elbow, 120, kX), 85, 2.0f);   // pronation
        EXPECT_NEAR(angle_after(elbow, -120, kX), 90, 2.0f);  // supination
    }
}

TEST_F(Limits, HoldTheShoulderFromBehindTheBack) {
    for (float side : {1.0f, -1.0f}) {
        const int arm = side > 0 ? VFIT_BONE_LEFT_UPPER_ARM : VFIT_BONE_RIGHT_UPPER_ARM;
        const Vec3 outwards(side, 0, 0);
        EXPECT_NEAR(angle_after(arm, side * 90, kZ), 90, 0.01f);  // straight up is allowed
        const Vec3 behind = limited(arm, glm::angleAxis(side * 85 * kDeg, kY)) * outwards;
        EXPECT_NEAR(behind.z, -std::sin(60 * kDeg), 0.02f);
        const Vec3 across = limited(arm, glm::angleAxis(-side * 160 * kDeg, kY)) * outwards;
        EXPECT_NEAR(side * across.x, -std::sin(45 * kDeg), 0.05f);
        EXPECT_NEAR(angle_after(arm, -140, kX), 105, 3.0f);  // external rotation
        EXPECT_NEAR(angle_after(arm, 140, kX), 90, 3.0f);    // internal rotation
    }
}

TEST_F(Limits, HoldHipAnkleAndWrist) {
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_UPPER_LEG, -160, kX), 130, 2.0f);
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_UPPER_LEG, 60, kX), 30, 2.0f);
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_UPPER_LEG, 80, kZ), 45, 2.0f);
    EXPECT_NEAR(angle_after(VFIT_BONE_RIGHT_UPPER_LEG, 80, kZ), 30, 2.0f);
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_UPPER_LEG, 80, kY), 50, 2.0f);   // external rotation
    EXPECT_NEAR(angle_after(VFIT_BONE_RIGHT_UPPER_LEG, 80, kY), 40, 2.0f);  // internal rotation
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_FOOT, -50, kX), 20, 0.1f);
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_FOOT, 80, kX), 55, 0.1f);
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_FOOT, -60, kZ), 35, 0.1f);
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_FOOT, 60, kZ), 20, 0.1f);
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_HAND, -110, kZ), 80, 3.0f);
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_HAND, -60, kY), 22, 3.0f);
    planted[0] = true;
    EXPECT_NEAR(angle_after(VFIT_BONE_LEFT_FOOT, -35, kX), 35, 0.01f);  // bent by the body's weight
}

TEST_F(Limits, HoldSpineAndNeckAsWholeChains) {
    BoneRotations local;
    local.fill(Quat(1, 0, 0, 0));
    for (int b : {VFIT_BONE_SPINE, VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST})
        local[size_t(b)] = glm::angleAxis(30 * kDeg, kY);
    local[VFIT_BONE_NECK] = local[VFIT_BONE_HEAD] = glm::angleAxis(60 * kDeg, kY);
    apply_joint_limits(rest, planted, local);
    const Quat spine = local[VFIT_BONE_SPINE] * local[VFIT_BONE_CHEST] * local[VFIT_BONE_UPPER_CHEST];
    EXPECT_NEAR(angle_of(spine) / kDeg, 40, 0.1f);
    EXPECT_NEAR(angle_of(local[VFIT_BONE_NECK] * local[VFIT_BONE_HEAD]) / kDeg, 80, 0.1f);
}

TEST_F(Limits, StayFiniteForAnyRotationAndAreStableWhenAppliedTwice) {
    testing::RandomPose random(5);
    for (int i = 0; i < 3000; ++i) {
        BoneRotations local;
        for (Quat& q : local)
            q = glm::normalize(Quat(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                                    random.uniform(-1, 1)));
        apply_joint_limits(rest, planted, local);
        BoneRotations again = local;
        apply_joint_limits(rest, planted, again);
        for (size_t b = 0; b < local.size(); ++b) {
            ASSERT_NEAR(glm::length(local[b]), 1.0f, 1e-4f) << bone_name(int(b));
            ASSERT_LT(angle_of(again[b] * glm::conjugate(local[b])), 0.02f) << bone_name(int(b));
        }
    }
}

}  // namespace
}  // namespace vfit
