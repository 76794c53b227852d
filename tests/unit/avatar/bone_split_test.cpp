// Fig. 7 of the paper on the baked body: a forearm turned by -90 degrees, with one bone and with several.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "body_fixture.h"

namespace vfit {
namespace {

struct Turned {
    double forearm_share;    // of its volume in the T-pose
    double whole_arm_share;  // upper arm, forearm and hand
    float worst_stretch;     // largest length of an arm's edge, in lengths of the T-pose
};

Turned turn_by(int bone, const AvatarDesc& desc) {
    Avatar avatar = make_avatar(desc);
    const BodyTopology& topology = avatar.topology();
    const std::vector<uint32_t> forearm = triangles_of(topology, BodyPart::kLeftForearm);
    const std::vector<uint32_t> others[] = {triangles_of(topology, BodyPart::kLeftUpperArm),
                                            triangles_of(topology, BodyPart::kLeftHand)};
    const std::vector<Vec3> before = avatar.positions();
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    pose.rotation[static_cast<size_t>(bone)] = glm::angleAxis(-0.5f * kPi, Vec3(1, 0, 0));
    avatar.pose(pose, *Jobs::own(0));

    const double forearm_before = enclosed_volume(before, forearm);
    const double forearm_after = enclosed_volume(avatar.positions(), forearm);
    double arm_before = forearm_before, arm_after = forearm_after;
    for (const auto& triangles : others) {
        arm_before += enclosed_volume(before, triangles);
        arm_after += enclosed_volume(avatar.positions(), triangles);
    }
    float worst = 0.0f;
    for (size_t t = 0; t < topology.indices.size(); ++t) {
        const uint32_t a = topology.indices[t], b = topology.indices[t - t % 3 + (t + 1) % 3];
        const bool arm =
            topology.parts[a] == BodyPart::kLeftUpperArm || topology.parts[a] == BodyPart::kLeftForearm;
        if (arm)
            worst = std::max(worst, glm::distance(avatar.positions()[a], avatar.positions()[b]) /
                                        glm::distance(before[a], before[b]));
    }
    return {forearm_after / forearm_before, arm_after / arm_before, worst};
}

AvatarDesc single_bones() {
    AvatarDesc desc;
    desc.single_bones = true;
    return desc;
}

AvatarDesc two_bones() {
    AvatarDesc desc;
    desc.twist_steps = 1;
    return desc;
}

TEST(BoneSplit, TurnedForearmKeepsMoreOfItsVolumeThanWithASingleBone) {
    const Turned one = turn_by(VFIT_BONE_LEFT_LOWER_ARM, single_bones());
    const Turned split = turn_by(VFIT_BONE_LEFT_LOWER_ARM, {});
    EXPECT_GT(split.forearm_share, one.forearm_share);
    EXPECT_GT(split.whole_arm_share, one.whole_arm_share);
}

TEST(BoneSplit, HandsTurnKeepsMoreOfTheArmsVolumeThanWithASingleBone) {
    EXPECT_GT(turn_by(VFIT_BONE_LEFT_HAND, {}).whole_arm_share,
              turn_by(VFIT_BONE_LEFT_HAND, single_bones()).whole_arm_share);
}

TEST(BoneSplit, ThePapersTwoBonesSpreadTheTearAtTheElbow) {
    const Turned one = turn_by(VFIT_BONE_LEFT_LOWER_ARM, single_bones());
    const Turned two = turn_by(VFIT_BONE_LEFT_LOWER_ARM, two_bones());
    const Turned split = turn_by(VFIT_BONE_LEFT_LOWER_ARM, {});
    EXPECT_LT(two.worst_stretch, one.worst_stretch);
    EXPECT_LT(split.worst_stretch, one.worst_stretch);
}

TEST(BoneSplit, VolumeGrowsWithTheStepsOfTheTwist) {
    double last = 0.0;
    for (const uint32_t steps : {1u, 2u, 4u, 8u}) {
        AvatarDesc desc;
        desc.twist_steps = steps;
        const double share = turn_by(VFIT_BONE_LEFT_LOWER_ARM, desc).forearm_share;
        EXPECT_GT(share, last) << steps << " steps";
        // Mean section of a linear blend over a step of the angle a: 1 - (1 - cos a) / 3.
        EXPECT_NEAR(share, 1.0 - (1.0 - std::cos(0.5 * double(kPi) / steps)) / 3.0, 0.015);
        last = share;
    }
}

TEST(BoneSplit, PoseWithoutTwistLooksTheSameWithAnyNumberOfBones) {
    Avatar one = make_avatar(single_bones()), split = make_avatar();
    Pose pose;
    pose.rotation[VFIT_BONE_LEFT_LOWER_ARM] = glm::angleAxis(-1.0f, Vec3(0, 1, 0));
    pose.rotation[VFIT_BONE_RIGHT_UPPER_LEG] = glm::angleAxis(-1.0f, Vec3(1, 0, 0));
    one.pose(pose, *Jobs::own(0));
    split.pose(pose, *Jobs::own(0));
    for (size_t v = 0; v < one.positions().size(); ++v)
        ASSERT_LT(glm::distance(one.positions()[v], split.positions()[v]), 1e-5f);
}

}  // namespace
}  // namespace vfit
