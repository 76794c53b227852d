// The rig from rest posture to pose: T-pose, agreement with forward kinematics, the split of a limb's twist.
#include "avatar/rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "math/quaternion.h"
#include "synthetic_rig.h"

namespace vfit {
namespace {

constexpr float kChainRoundingM = 2e-6f;  // float rounding of a chain of ten bones of a metre

struct Posed {
    PosedSkeleton skeleton;
    std::vector<Mat4> matrices;
};

Posed run(const AvatarRig& rig, const Pose& pose) {
    Posed out;
    out.matrices.resize(rig.bones().size());
    rig.pose(pose, out.skeleton, out.matrices);
    return out;
}

Vec3 carried(const AvatarRig& rig, const Posed& posed, int rig_bone, const Vec3& rest) {
    EXPECT_LT(static_cast<size_t>(rig_bone), rig.bones().size());
    return Vec3(posed.matrices[static_cast<size_t>(rig_bone)] * Vec4(rest, 1.0f));
}

Quat turn_of(const Mat4& m) { return glm::quat_cast(Mat3(m)); }

float angle_between(const Quat& a, const Quat& b) { return angle_of(glm::conjugate(a) * b); }

Pose lively_pose() {
    Pose pose;
    pose.hips_position = Vec3(0.4f, 0.9f, -1.5f);
    for (int b = 0; b < kBoneCount; ++b) {
        const Vec3 axis(float(b % 3) - 1.0f, 0.6f, float(b % 5) - 2.0f);
        pose.rotation[static_cast<size_t>(b)] = glm::angleAxis(0.2f + 0.05f * float(b), glm::normalize(axis));
    }
    return pose;
}

TEST(AvatarRig, TheRestPoseLeavesTheSkinWhereItIs) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 1);
    const Posed posed = run(rig, rig.rest_pose());
    for (const Mat4& m : posed.matrices)
        for (int c = 0; c < 4; ++c) EXPECT_LT(glm::distance(m[c], Mat4(1.0f)[c]), 0.005f);
}

TEST(AvatarRig, IdentityPoseIsATPose) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 1);
    Pose pose;
    pose.hips_position = rig.skeleton().offset[VFIT_BONE_HIPS];
    const Posed posed = run(rig, pose);
    for (const LimbChain& limb : rig.limbs()) {
        const Vec3 along = posed.skeleton.position[static_cast<size_t>(limb.end_bone)] -
                           posed.skeleton.position[static_cast<size_t>(limb.bone)];
        EXPECT_NEAR(glm::dot(glm::normalize(along), t_pose_direction(limb.bone)), 1.0f, 1e-6f)
            << bone_name(limb.bone);
    }
    const int hand = rig.rig_bone(VFIT_BONE_LEFT_HAND);
    const AvatarBone& left = rig.bones()[static_cast<size_t>(hand)];
    const Vec3 palm = carried(rig, posed, hand, left.rest_tail) - carried(rig, posed, hand, left.rest_head);
    EXPECT_NEAR(glm::normalize(palm).x, 1.0f, 1e-6f);
}

TEST(AvatarRig, TPoseStandsOnTheFloor) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 1);
    Pose pose;
    pose.hips_position = rig.skeleton().offset[VFIT_BONE_HIPS];
    const Posed posed = run(rig, pose);
    EXPECT_NEAR(posed.skeleton.position[VFIT_BONE_LEFT_FOOT].y, 0.09f, kChainRoundingM);
    EXPECT_NEAR(rig.skeleton().ankle_height, 0.09f, kChainRoundingM);
    const Vec3 between =
        posed.skeleton.position[VFIT_BONE_LEFT_FOOT] + posed.skeleton.position[VFIT_BONE_RIGHT_FOOT];
    EXPECT_NEAR(between.x, 0.0f, kChainRoundingM);
    EXPECT_NEAR(between.z, 0.0f, kChainRoundingM);
}

TEST(AvatarRig, BonesStandWhereForwardKinematicsPutsThem) {
    for (const uint32_t steps : {0u, 1u, 4u}) {
        const AvatarRig rig(synthetic_rig(), 0.0f, steps);
        const Pose pose = lively_pose();
        const Posed posed = run(rig, pose);
        const PosedSkeleton expected = forward_kinematics(rig.skeleton(), pose);
        for (int b = 0; b < kBoneCount; ++b) {
            const int bone = rig.rig_bone(b);
            const Vec3 at = carried(rig, posed, bone, rig.bones()[static_cast<size_t>(bone)].rest_head);
            EXPECT_LT(glm::distance(at, expected.position[static_cast<size_t>(b)]), kChainRoundingM)
                << bone_name(b);
        }
    }
}

TEST(AvatarRig, ChildrenStayAttachedToTheirLimb) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 4);
    const Posed posed = run(rig, lively_pose());
    for (const LimbChain& limb : rig.limbs())
        for (const int bone : limb.rig_bones) {
            const Vec3 end = carried(rig, posed, bone, limb.far_joint);
            EXPECT_LT(glm::distance(end, posed.skeleton.position[static_cast<size_t>(limb.end_bone)]),
                      kChainRoundingM)
                << rig.bones()[static_cast<size_t>(bone)].name;
        }
}

TEST(AvatarRig, BonesBetweenAndFingersFollowTheirParent) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 1);
    const Posed posed = run(rig, lively_pose());
    for (size_t i = 0; i < rig.bones().size(); ++i) {
        const std::string& name = rig.bones()[i].name;
        if (name != "spine.between" && name != "finger.L" && name != "shoulder.R") continue;
        EXPECT_EQ(posed.matrices[i], posed.matrices[static_cast<size_t>(rig.bones()[i].parent)]) << name;
    }
}

TEST(AvatarRig, OriginalBoneKeepsPitchAndRollAndExtensionTakesTheTwist) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 1);
    const LimbChain& arm = rig.limbs().front();
    ASSERT_EQ(arm.bone, VFIT_BONE_LEFT_UPPER_ARM);
    ASSERT_EQ(arm.rig_bones.size(), 2u);
    const Quat swing = glm::angleAxis(0.8f, glm::normalize(Vec3(0, 0.3f, -1)));
    const Quat twist = glm::angleAxis(0.6f, Vec3(1, 0, 0));
    Pose still, swung, twisted;
    swung.rotation[VFIT_BONE_LEFT_UPPER_ARM] = swing;
    twisted.rotation[VFIT_BONE_LEFT_UPPER_ARM] = swing * twist;
    const auto original = static_cast<size_t>(arm.rig_bones[0]),
               extension = static_cast<size_t>(arm.rig_bones[1]);
    const Posed a = run(rig, swung), b = run(rig, twisted);
    EXPECT_NEAR(angle_between(turn_of(a.matrices[original]), turn_of(b.matrices[original])), 0.0f, 1e-3f);
    EXPECT_NEAR(angle_between(turn_of(a.matrices[extension]), turn_of(b.matrices[extension])), 0.6f, 1e-3f);
}

TEST(AvatarRig, TwistGrowsEvenlyAlongTheSteps) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 4);
    const LimbChain& fore = rig.limbs()[1];
    ASSERT_EQ(fore.bone, VFIT_BONE_LEFT_LOWER_ARM);
    ASSERT_EQ(fore.rig_bones.size(), 5u);
    Pose pose;
    pose.rotation[VFIT_BONE_LEFT_LOWER_ARM] = glm::angleAxis(-0.5f * kPi, Vec3(1, 0, 0));
    const Posed posed = run(rig, pose);
    const Quat first = turn_of(posed.matrices[static_cast<size_t>(fore.rig_bones[0])]);
    for (size_t k = 0; k < 5; ++k)
        EXPECT_NEAR(angle_between(first, turn_of(posed.matrices[static_cast<size_t>(fore.rig_bones[k])])),
                    0.125f * kPi * float(k), 1e-3f);
}

TEST(AvatarRig, HandsPronationTurnsTheForearmAndLeavesTheHandWhereItIs) {
    const AvatarRig split(synthetic_rig(), 0.0f, 1), single(synthetic_rig(), 0.0f, 0);
    const LimbChain& fore = split.limbs()[1];
    Pose pose;
    pose.rotation[VFIT_BONE_LEFT_LOWER_ARM] = glm::angleAxis(-0.7f, Vec3(0, 1, 0));
    pose.rotation[VFIT_BONE_LEFT_HAND] =
        glm::angleAxis(1.1f, Vec3(1, 0, 0)) * glm::angleAxis(0.4f, glm::normalize(Vec3(0, 1, 0.2f)));
    const Posed a = run(split, pose), b = run(single, pose);
    const auto hand = static_cast<size_t>(split.rig_bone(VFIT_BONE_LEFT_HAND));
    EXPECT_NEAR(angle_between(turn_of(a.matrices[hand]), turn_of(b.matrices[hand])), 0.0f, 1e-3f);
    const Quat original = turn_of(a.matrices[static_cast<size_t>(fore.rig_bones[0])]);
    const Quat extension = turn_of(a.matrices[static_cast<size_t>(fore.rig_bones[1])]);
    EXPECT_NEAR(angle_between(original, extension), 1.1f, 1e-3f);
    const Quat rest_of_hand = glm::conjugate(extension) * turn_of(a.matrices[hand]);
    Pose straight;
    straight.rotation[VFIT_BONE_LEFT_LOWER_ARM] = pose.rotation[VFIT_BONE_LEFT_LOWER_ARM];
    const Posed c = run(split, straight);
    const Quat rest_relation = glm::conjugate(turn_of(c.matrices[static_cast<size_t>(fore.rig_bones[1])])) *
                               turn_of(c.matrices[hand]);
    EXPECT_NEAR(angle_between(rest_relation, rest_of_hand), 0.4f, 1e-3f);
}

TEST(AvatarRig, SingleBonesTurnTheWholeLimb) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 0);
    const Posed posed = run(rig, lively_pose());
    for (const LimbChain& limb : rig.limbs())
        EXPECT_EQ(posed.matrices[static_cast<size_t>(limb.rig_bones.front())],
                  posed.matrices[static_cast<size_t>(limb.rig_bones.back())]);
}

TEST(AvatarRig, PoseThatIsNotFiniteIsRefusedAndChangesNothing) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 1);
    Posed posed = run(rig, lively_pose());
    const std::vector<Mat4> before = posed.matrices;
    const auto expect_refused = [&](const Pose& pose, const char* part) {
        try {
            rig.pose(pose, posed.skeleton, posed.matrices);
            FAIL() << "accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
        EXPECT_EQ(posed.matrices, before);
    };
    Pose pose;
    pose.rotation[VFIT_BONE_HEAD].x = std::numeric_limits<float>::quiet_NaN();
    expect_refused(pose, "head");
    pose = Pose();
    pose.hips_position.y = std::numeric_limits<float>::infinity();
    expect_refused(pose, "hips");
    pose = Pose();
    pose.rotation[VFIT_BONE_LEFT_FOOT] = Quat(0, 0, 0, 0);
    expect_refused(pose, "leftFoot");
}

std::vector<AvatarBone> rig_without(std::initializer_list<int> missing) {
    std::vector<AvatarBone> bones = synthetic_rig();
    for (AvatarBone& bone : bones)
        for (const int m : missing)
            if (bone.bone == m) bone.bone = -1;
    return bones;
}

TEST(AvatarRig, RigWithoutARequiredBoneIsRefusedByName) {
    for (int b = 0; b < kBoneCount; ++b) {
        if (is_optional_bone(b)) {
            EXPECT_NO_THROW(AvatarRig(rig_without({b}), 0.0f, 1)) << bone_name(b);
            continue;
        }
        try {
            const AvatarRig rig(rig_without({b}), 0.0f, 1);
            FAIL() << "accepted without " << bone_name(b);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
            EXPECT_NE(std::string(error.what()).find(bone_name(b)), std::string::npos);
        }
    }
}

TEST(AvatarRig, OthersTurnForMissingBones) {
    const AvatarRig rig(
        rig_without({VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST, VFIT_BONE_NECK, VFIT_BONE_LEFT_SHOULDER}), 0.0f,
        1);
    const AvatarRig full(synthetic_rig(), 0.0f, 1);
    const Posed posed = run(rig, lively_pose()), wanted = run(full, lively_pose());
    const auto turn = [](const AvatarRig& r, const Posed& p, int bone) {
        return turn_of(p.matrices[static_cast<size_t>(r.rig_bone(bone))]);
    };
    // What hangs on missing bones is turned as by a full rig; the spine takes what the chest would.
    for (const int b : {VFIT_BONE_HIPS, VFIT_BONE_HEAD, VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_HAND,
                        VFIT_BONE_RIGHT_UPPER_ARM})
        EXPECT_LT(angle_between(turn(rig, posed, b), turn(full, wanted, b)), 0.1f) << bone_name(b);
    EXPECT_LT(angle_between(turn(rig, posed, VFIT_BONE_SPINE), turn(full, wanted, VFIT_BONE_UPPER_CHEST)),
              1e-3f);
    // The head turns in its place: on the neck's way it would leave the trunk.
    const Vec3 head = posed.skeleton.position[VFIT_BONE_HEAD];
    EXPECT_LT(glm::distance(
                  head, carried(rig, posed, rig.rig_bone(VFIT_BONE_SPINE), rig.rest_head(VFIT_BONE_HEAD))),
              1e-4f);
}

TEST(AvatarRig, RigWithoutTwistSegmentsGetsThem) {
    std::vector<AvatarBone> bones = synthetic_rig();
    for (AvatarBone& bone : bones) {  // the forearm's segment becomes a leaf
        if (bone.bone == VFIT_BONE_LEFT_HAND) bone.parent = bones[static_cast<size_t>(bone.parent)].parent;
    }
    const AvatarRig with(synthetic_rig(), 0.0f, 1), without(bones, 0.0f, 1);
    ASSERT_EQ(without.bones().size(), with.bones().size() + 1);
    const LimbChain& fore = without.limbs()[1];
    ASSERT_EQ(fore.rig_bones.size(), 2u);
    EXPECT_EQ(without.bones()[static_cast<size_t>(fore.rig_bones.back())].parent,
              without.rig_bone(VFIT_BONE_LEFT_LOWER_ARM));
}

}  // namespace
}  // namespace vfit
