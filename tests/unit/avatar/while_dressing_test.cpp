// The body that a garment is put on: from standing straight to the pose, with the avatar left as it is.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "body_fixture.h"

namespace vfit {
namespace {

struct Dressed {
    std::vector<Mat4> matrices;
    std::vector<Collider> colliders;

    Dressed(const Avatar& avatar, float share) : matrices(avatar.skinning_matrices().size()) {
        avatar.while_dressing(share, matrices, colliders);
    }
    const Vec3& at(int joint) const { return colliders[static_cast<size_t>(joint)].center; }
};

Avatar striding() {
    Avatar avatar = make_avatar();
    Pose pose;
    pose.hips_position = Vec3(0.5f, 0.95f, -2.0f);
    pose.rotation[VFIT_BONE_HIPS] = glm::angleAxis(0.8f, Vec3(0, 1, 0));
    pose.rotation[VFIT_BONE_LEFT_UPPER_LEG] = glm::angleAxis(-0.6f, Vec3(1, 0, 0));
    pose.rotation[VFIT_BONE_RIGHT_UPPER_LEG] =
        -glm::angleAxis(0.5f, Vec3(1, 0, 0));  // the same turn, other sign
    pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = glm::angleAxis(-1.4f, Vec3(0, 0, 1));
    avatar.pose(pose, *Jobs::own(0));
    return avatar;
}

TEST(WhileDressing, EndsInThePose) {
    const Avatar avatar = striding();
    const Dressed end(avatar, 1.0f);
    for (size_t i = 0; i < end.matrices.size(); ++i)
        for (int column = 0; column < 4; ++column)
            ASSERT_LT(glm::length(end.matrices[i][column] - avatar.skinning_matrices()[i][column]), 1e-5f)
                << i;
    std::vector<Collider> posed;
    avatar.colliders(posed);
    ASSERT_EQ(end.colliders.size(), posed.size());
    for (size_t i = 0; i < posed.size(); ++i)
        EXPECT_LT(glm::distance(end.colliders[i].center, posed[i].center), 1e-5f);
}

TEST(BoneAxes, RunFromJointToJointOfThePosedBody) {
    const Avatar avatar = striding();
    const std::vector<BoneAxis> axes = avatar.bone_axes(avatar.skinning_matrices());
    ASSERT_EQ(axes.size(), avatar.rig_bones().size());
    const Body joints = avatar.joints();
    for (const LimbChain& limb : avatar.limbs()) {
        if (limb.bone != VFIT_BONE_LEFT_UPPER_LEG) continue;
        for (const int bone : limb.rig_bones) {
            EXPECT_LT(glm::distance(axes[size_t(bone)].from, joints.at(VFIT_JOINT_LEFT_HIP)), 0.01f);
            EXPECT_LT(glm::distance(axes[size_t(bone)].to, joints.at(VFIT_JOINT_LEFT_KNEE)), 0.01f);
        }
        return;
    }
    FAIL() << "no thigh";
}

TEST(WhileDressing, BeginsUprightOverTheHipsWithArmsAndLegsApart) {
    const Avatar avatar = striding();
    const Dressed begin(avatar, 0.0f);
    const Vec3 left(std::cos(0.8f), 0, -std::sin(0.8f));  // of the turned hips
    for (const auto& [hip, foot, outwards] :
         {std::tuple(VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_FOOT, left),
          std::tuple(VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_FOOT, -left)}) {
        const Vec3 along = glm::normalize(begin.at(foot) - begin.at(hip));
        EXPECT_LT(along.y, -0.98f);
        EXPECT_NEAR(glm::dot(along, outwards), 0.12f, 0.03f);
    }
    EXPECT_GT(glm::dot(begin.at(VFIT_JOINT_LEFT_HAND) - begin.at(VFIT_JOINT_LEFT_SHOULDER), left), 0.25f);
    EXPECT_LT(glm::dot(begin.at(VFIT_JOINT_RIGHT_HAND) - begin.at(VFIT_JOINT_RIGHT_SHOULDER), left), -0.25f);
    const Vec3 hips = 0.5f * (begin.at(VFIT_JOINT_LEFT_HIP) + begin.at(VFIT_JOINT_RIGHT_HIP));
    const Body joints = avatar.joints();
    const Vec3 posed = 0.5f * (joints.at(VFIT_JOINT_LEFT_HIP) + joints.at(VFIT_JOINT_RIGHT_HIP));
    EXPECT_LT(glm::distance(hips, posed), 1e-5f);
}

TEST(WhileDressing, TurnsEveryLimbTheShortWayInSmallSteps) {
    const Avatar avatar = striding();
    Dressed before(avatar, 0.0f);
    for (int i = 1; i <= 40; ++i) {
        Dressed now(avatar, float(i) / 40.0f);
        for (int j = 0; j < kPaperJointCount; ++j)
            ASSERT_LT(glm::distance(now.at(j), before.at(j)), 0.03f) << joint_name(j) << " at " << i;
        before = std::move(now);
    }
}

TEST(WhileDressing, LeavesTheAvatarInItsPose) {
    const Avatar avatar = striding();
    const std::vector<Vec3> skin = avatar.positions();
    const Vec3 knee = avatar.joints().at(VFIT_JOINT_LEFT_KNEE);
    const Dressed other(avatar, 0.3f);
    EXPECT_EQ(avatar.positions(), skin);
    EXPECT_EQ(avatar.joints().at(VFIT_JOINT_LEFT_KNEE), knee);
    EXPECT_NE(other.at(VFIT_JOINT_LEFT_KNEE), knee);
}

}  // namespace
}  // namespace vfit
