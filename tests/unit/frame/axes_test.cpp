#include "frame/axes.h"

#include <gtest/gtest.h>

#include "body/skeleton.h"
#include "core/error.h"

namespace vfit {
namespace {

const Vec3 kLeft(1, 0, 0), kUp(0, 1, 0), kForward(0, 0, 1);  // of a person who faces the camera

void expect_near(const Vec3& a, const Vec3& b) { EXPECT_LT(glm::length(a - b), 1e-4f); }

class AxesTest : public testing::TestWithParam<std::tuple<vfit_axes, bool>> {
protected:
    Axes axes{std::get<0>(GetParam()), std::get<1>(GetParam())};
};

TEST_P(AxesTest, WhatGoesOutComesBackIn) {
    const Vec3 p(0.3f, 1.7f, -2.2f);
    expect_near(axes.point_in(axes.point_out(p)), p);
    const Quat q = glm::normalize(Quat(0.4f, 0.1f, -0.7f, 0.2f));
    EXPECT_GT(glm::dot(axes.rotation_in(axes.rotation_out(q)), q), 1.0f - 1e-5f);
    EXPECT_FLOAT_EQ(axes.length_in(axes.length_out(0.25f)), 0.25f);
}

TEST_P(AxesTest, RotatingThenWritingIsWritingThenRotating) {
    const Vec3 p(0.3f, 1.7f, -2.2f);
    const Quat q = glm::normalize(Quat(0.4f, 0.1f, -0.7f, 0.2f));
    expect_near(axes.rotation_out(q) * axes.point_out(p) / axes.unit(), axes.point_out(q * p) / axes.unit());
}

TEST_P(AxesTest, MatricesActOnWrittenPointsAsTheyDidInside) {
    const Vec3 p(0.3f, 1.7f, -2.2f);
    Mat4 m = glm::mat4_cast(glm::normalize(Quat(0.4f, 0.1f, -0.7f, 0.2f)));
    m[3] = Vec4(0.5f, -0.25f, 2.0f, 1.0f);
    const Vec3 inside(m * Vec4(p, 1.0f));
    expect_near(Vec3(axes.matrix_out(m) * Vec4(axes.point_out(p), 1.0f)) / axes.unit(),
                axes.point_out(inside) / axes.unit());
}

TEST_P(AxesTest, TrianglesTurnOverExactlyWhenHandednessDoes) {
    const Vec3 a = axes.direction_out(kLeft), b = axes.direction_out(kUp), c = axes.direction_out(kForward);
    EXPECT_EQ(glm::dot(glm::cross(a, b), c) < 0.0f, axes.flips_winding());
}

TEST_P(AxesTest, MirroredBonesComeInPairs) {
    for (int bone = 0; bone < kBoneCount; ++bone) {
        EXPECT_EQ(axes.bone_out(axes.bone_out(bone)), bone);
        if (!axes.mirrored()) {
            EXPECT_EQ(axes.bone_out(bone), bone);
        }
    }
    for (int joint = 0; joint < kJointCount; ++joint) EXPECT_EQ(axes.joint_out(axes.joint_out(joint)), joint);
}

INSTANTIATE_TEST_SUITE_P(
    All, AxesTest,
    testing::Combine(testing::Values(VFIT_AXES_RH_Y_UP, VFIT_AXES_UNITY, VFIT_AXES_UNREAL), testing::Bool()));

TEST(Axes, UnityKeepsUpAndForwardAndPutsTheLeftOnMinusX) {
    const Axes axes(VFIT_AXES_UNITY, false);
    expect_near(axes.direction_out(kUp), {0, 1, 0});
    expect_near(axes.direction_out(kForward), {0, 0, 1});
    expect_near(axes.direction_out(kLeft), {-1, 0, 0});
    EXPECT_TRUE(axes.flips_v());
}

TEST(Axes, UnrealIsInCentimetresWithZUpAndXForward) {
    const Axes axes(VFIT_AXES_UNREAL, false);
    expect_near(axes.point_out(kUp), {0, 0, 100});
    expect_near(axes.point_out(kForward), {100, 0, 0});
    expect_near(axes.point_out(kLeft), {0, -100, 0});
}

TEST(Axes, AMirrorSwapsSides) {
    const Axes axes(VFIT_AXES_RH_Y_UP, true);
    expect_near(axes.direction_out(kLeft), {-1, 0, 0});
    EXPECT_EQ(axes.bone_out(VFIT_BONE_LEFT_HAND), VFIT_BONE_RIGHT_HAND);
    EXPECT_EQ(axes.bone_out(VFIT_BONE_RIGHT_TOES), VFIT_BONE_LEFT_TOES);
    EXPECT_EQ(axes.bone_out(VFIT_BONE_HEAD), VFIT_BONE_HEAD);
    EXPECT_EQ(axes.joint_out(VFIT_JOINT_LEFT_KNEE), VFIT_JOINT_RIGHT_KNEE);
    EXPECT_EQ(axes.joint_out(VFIT_JOINT_RIGHT_WRIST), VFIT_JOINT_LEFT_WRIST);
    EXPECT_EQ(axes.joint_out(VFIT_JOINT_CHEST), VFIT_JOINT_CHEST);
}

TEST(Axes, AnUnknownConventionIsRefused) { EXPECT_THROW(Axes(3, false), Error); }

}  // namespace
}  // namespace vfit
