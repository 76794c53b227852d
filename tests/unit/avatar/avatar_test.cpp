// The avatar of the baked body: its T-pose, rigid motion, symmetry, scale and agreement with forward
// kinematics.
#include "avatar/avatar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "body_fixture.h"
#include "core/error.h"
#include "geometry/mesh_query.h"

namespace vfit {
namespace {

constexpr float kRoundingM = 5e-6f;  // of float chains at the size of a room

Pose standing(const Avatar& avatar) {
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    return pose;
}

Pose lively(const Avatar& avatar) {
    Pose pose = standing(avatar);
    pose.rotation[VFIT_BONE_SPINE] = glm::angleAxis(0.2f, Vec3(0, 1, 0));
    pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = glm::angleAxis(-0.9f, glm::normalize(Vec3(0.4f, 0.2f, 1)));
    pose.rotation[VFIT_BONE_LEFT_LOWER_ARM] = glm::angleAxis(-1.2f, Vec3(0, 1, 0));
    pose.rotation[VFIT_BONE_LEFT_HAND] = glm::angleAxis(0.8f, Vec3(1, 0, 0));
    pose.rotation[VFIT_BONE_RIGHT_UPPER_LEG] = glm::angleAxis(-0.7f, Vec3(1, 0, 0));
    pose.rotation[VFIT_BONE_RIGHT_LOWER_LEG] = glm::angleAxis(0.9f, Vec3(1, 0, 0));
    pose.rotation[VFIT_BONE_HEAD] = glm::angleAxis(0.4f, Vec3(0, 1, 0));
    return pose;
}

/// The same pose by the other side of the body: reflected at x = 0.
Pose mirrored(const Pose& pose) {
    const auto other = [](int bone) {
        const std::string name = bone_name(bone);
        const bool left = name.starts_with("left");
        if (!left && !name.starts_with("right")) return bone;
        const std::string wanted = (left ? "right" : "left") + name.substr(left ? 4 : 5);
        for (int b = 0; b < kBoneCount; ++b)
            if (bone_name(b) == wanted) return b;
        return -1;
    };
    Pose out = pose;
    out.hips_position.x = -out.hips_position.x;
    for (int b = 0; b < kBoneCount; ++b) {
        const Quat& q = pose.rotation[static_cast<size_t>(other(b))];
        out.rotation[static_cast<size_t>(b)] = Quat(q.w, q.x, -q.y, -q.z);
    }
    return out;
}

float height(const std::vector<Vec3>& positions) {
    float low = positions.front().y, high = low;
    for (const Vec3& p : positions) low = std::min(low, p.y), high = std::max(high, p.y);
    return high - low;
}

TEST(Avatar, StandsInATPoseUntilPosed) {
    const Avatar avatar = make_avatar();
    const Body joints = avatar.joints();
    const auto& parts = avatar.parts();
    for (size_t v = 0; v < avatar.topology().vertex_count; ++v) {
        const Vec3& p = avatar.positions()[v];
        const bool left = parts[v] == BodyPart::kLeftForearm || parts[v] == BodyPart::kLeftHand;
        const bool right = parts[v] == BodyPart::kRightForearm || parts[v] == BodyPart::kRightHand;
        if (!left && !right) continue;
        const Vec3& elbow = joints.at(left ? VFIT_JOINT_LEFT_ELBOW : VFIT_JOINT_RIGHT_ELBOW);
        // Beyond the shoulder, and within half a hand's length of the arm's axis.
        EXPECT_GT(std::abs(p.x), joints.at(VFIT_JOINT_LEFT_SHOULDER).x);
        EXPECT_EQ(left, p.x > 0.0f);
        EXPECT_LT(std::abs(p.y - elbow.y), 0.08f);
        EXPECT_LT(std::abs(p.z - elbow.z), 0.09f);
    }
    EXPECT_NEAR(joints.at(VFIT_JOINT_LEFT_WRIST).y, joints.at(VFIT_JOINT_LEFT_SHOULDER).y, kRoundingM);
    EXPECT_NEAR(joints.at(VFIT_JOINT_RIGHT_KNEE).x, joints.at(VFIT_JOINT_RIGHT_HIP).x, kRoundingM);
}

TEST(Avatar, TPoseKeepsThePalmsDownAndTheSolesOnTheFloor) {
    const Avatar avatar = make_avatar();
    const Body joints = avatar.joints();
    for (size_t i = 0; i < avatar.rig_bones().size(); ++i) {
        const AvatarBone& bone = avatar.rig_bones()[i];
        if (bone.name != "finger1-1.L" && bone.name != "finger1-1.R") continue;
        const Vec3 thumb(avatar.skinning_matrices()[i] * Vec4(bone.rest_head, 1.0f));
        const Vec3& palm = joints.at(bone.name.back() == 'L' ? VFIT_JOINT_LEFT_HAND : VFIT_JOINT_RIGHT_HAND);
        EXPECT_GT(thumb.z - palm.z, std::abs(thumb.y - palm.y)) << bone.name;
    }
    float low = 1.0f;
    for (const Vec3& p : avatar.positions()) low = std::min(low, p.y);
    EXPECT_NEAR(low, 0.0f, 0.005f);  // the skin of the ankle gives a little when the legs straighten
}

// Winter: the hand's centre of mass lies .506 of the way from the wrist to the middle finger's second
// knuckle, and wrist to fingertip is .108 of stature.
TEST(Avatar, HandJointLiesInThePalmAThirdOfTheHandFromTheWrist) {
    const Avatar avatar = make_avatar();
    const Body joints = avatar.joints();
    for (const int side : {0, 1}) {
        const Vec3 wrist = joints.at(VFIT_JOINT_LEFT_WRIST + side),
                   hand = joints.at(VFIT_JOINT_LEFT_HAND + side);
        const Vec3 elbow = joints.at(VFIT_JOINT_LEFT_ELBOW + side);
        EXPECT_NEAR(glm::distance(wrist, hand), 0.38f * 0.108f * avatar.stature(), 0.006f);
        EXPECT_GT(glm::dot(glm::normalize(hand - wrist), glm::normalize(wrist - elbow)), 0.9f);
    }
}

TEST(Avatar, HipsMoveTheWholeBodyRigidly) {
    Avatar avatar = make_avatar();
    const auto jobs = Jobs::own(1);
    const Pose pose = lively(avatar);
    avatar.pose(pose, *jobs);
    const std::vector<Vec3> before = avatar.positions(), normals = avatar.normals();
    Pose moved = pose;
    const Quat turn = glm::angleAxis(1.1f, glm::normalize(Vec3(0.2f, 1, -0.4f)));
    const Vec3 shift(0.7f, -0.2f, 1.9f);
    moved.hips_position = pose.hips_position + shift;
    moved.rotation[VFIT_BONE_HIPS] = turn * pose.rotation[VFIT_BONE_HIPS];
    avatar.pose(moved, *jobs);
    for (size_t v = 0; v < before.size(); ++v) {
        const Vec3 expected = turn * (before[v] - pose.hips_position) + moved.hips_position;
        ASSERT_LT(glm::distance(avatar.positions()[v], expected), kRoundingM);
        ASSERT_LT(glm::distance(avatar.normals()[v], turn * normals[v]), 1e-4f);
    }
}

TEST(Avatar, JointsStandWhereForwardKinematicsPutsTheBones) {
    Avatar avatar = make_avatar();
    Pose pose = lively(avatar);
    pose.time_ns = 77;
    avatar.pose(pose, *Jobs::own(0));
    const PosedSkeleton expected = forward_kinematics(avatar.skeleton(), pose);
    const Body joints = avatar.joints();
    EXPECT_EQ(joints.time_ns, 77);
    const std::pair<int, int> pairs[] = {{VFIT_JOINT_PELVIS, VFIT_BONE_HIPS},
                                         {VFIT_JOINT_TORSO, VFIT_BONE_CHEST},
                                         {VFIT_JOINT_CHEST, VFIT_BONE_UPPER_CHEST},
                                         {VFIT_JOINT_NECK, VFIT_BONE_NECK},
                                         {VFIT_JOINT_LEFT_CLAVICLE, VFIT_BONE_LEFT_SHOULDER},
                                         {VFIT_JOINT_LEFT_SHOULDER, VFIT_BONE_LEFT_UPPER_ARM},
                                         {VFIT_JOINT_LEFT_ELBOW, VFIT_BONE_LEFT_LOWER_ARM},
                                         {VFIT_JOINT_LEFT_WRIST, VFIT_BONE_LEFT_HAND},
                                         {VFIT_JOINT_RIGHT_HIP, VFIT_BONE_RIGHT_UPPER_LEG},
                                         {VFIT_JOINT_RIGHT_KNEE, VFIT_BONE_RIGHT_LOWER_LEG},
                                         {VFIT_JOINT_RIGHT_FOOT, VFIT_BONE_RIGHT_FOOT},
                                         {VFIT_JOINT_RIGHT_TOES, VFIT_BONE_RIGHT_TOES}};
    for (const auto& [joint, bone] : pairs) {
        const Joint& j = joints.joints[static_cast<size_t>(joint)];
        EXPECT_LT(glm::distance(j.position, expected.position[static_cast<size_t>(bone)]), kRoundingM)
            << joint_name(joint);
        EXPECT_TRUE(j.has_rotation);
        EXPECT_GT(std::abs(glm::dot(j.rotation, expected.rotation[static_cast<size_t>(bone)])), 1.0f - 1e-5f);
    }
    for (int j = 0; j < kJointCount; ++j)
        EXPECT_EQ(joints.joints[static_cast<size_t>(j)].state, VFIT_JOINT_MEASURED);
}

TEST(Avatar, JointsLieInsideTheBody) {
    Avatar avatar = make_avatar();
    const MeshQuery skin(std::span(avatar.positions()).first(avatar.topology().vertex_count),
                         avatar.topology().indices);
    const Body joints = avatar.joints();
    for (int j = 0; j < kPaperJointCount; ++j) EXPECT_TRUE(skin.inside(joints.at(j))) << joint_name(j);
}

TEST(Avatar, MirroredPoseGivesTheMirroredBody) {
    Avatar avatar = make_avatar();
    const auto jobs = Jobs::own(0);
    const Pose pose = lively(avatar);
    avatar.pose(pose, *jobs);
    const std::vector<Vec3> one = avatar.positions();
    const Body one_joints = avatar.joints();
    avatar.pose(mirrored(pose), *jobs);
    const Body other = avatar.joints();
    for (int j = 0; j < kJointCount; ++j) {
        Vec3 expected = one_joints.at(mirrored_joint(j));
        expected.x = -expected.x;
        EXPECT_LT(glm::distance(other.at(j), expected), 0.002f) << joint_name(j);
    }
    const MeshQuery skin(std::span(avatar.positions()).first(avatar.topology().vertex_count),
                         avatar.topology().indices);
    float worst = 0.0f;
    for (size_t v = 0; v < avatar.topology().vertex_count; ++v)
        worst = std::max(worst, skin.closest(Vec3(-one[v].x, one[v].y, one[v].z)).distance);
    EXPECT_LT(worst, 0.003f);  // the data is symmetric to about a millimetre
}

TEST(Avatar, ScaleStretchesStatureAndBreadthEachByItsOwnFactor) {
    const Avatar plain = make_avatar(), scaled = make_avatar({}, Vec2(1.2f, 0.9f));
    for (size_t v = 0; v < plain.rest().positions.size(); ++v) {
        const Vec3 expected = plain.rest().positions[v] * Vec3(1.2f, 0.9f, 1.2f);
        ASSERT_LT(glm::distance(scaled.rest().positions[v], expected), kRoundingM);
    }
    EXPECT_NEAR(scaled.stature() / plain.stature(), 0.9f, 0.005f);
    const auto breadth = [](const Avatar& a) {
        return a.joints().at(VFIT_JOINT_LEFT_SHOULDER).x - a.joints().at(VFIT_JOINT_RIGHT_SHOULDER).x;
    };
    EXPECT_NEAR(breadth(scaled) / breadth(plain), 1.2f, 1e-4f);
}

TEST(Avatar, SeamCopiesFollowTheirSource) {
    Avatar avatar = make_avatar();
    avatar.pose(lively(avatar), *Jobs::own(0));
    const BodyTopology& topology = avatar.topology();
    ASSERT_EQ(avatar.positions().size(), topology.render_vertex_count);
    ASSERT_GT(topology.seam_sources.size(), 0u);
    for (size_t i = 0; i < topology.seam_sources.size(); ++i) {
        const size_t copy = topology.vertex_count + i, source = topology.seam_sources[i];
        ASSERT_EQ(avatar.positions()[copy], avatar.positions()[source]);
        ASSERT_EQ(avatar.normals()[copy], avatar.normals()[source]);
        ASSERT_EQ(avatar.skin_bones()[copy], avatar.skin_bones()[source]);
        ASSERT_EQ(avatar.skin_weights()[copy], avatar.skin_weights()[source]);
    }
}

TEST(Avatar, MatricesAndWeightsReproduceThePosedSkin) {
    Avatar avatar = make_avatar();
    avatar.pose(lively(avatar), *Jobs::own(0));
    for (size_t v = 0; v < avatar.positions().size(); v += 7) {
        Vec3 sum(0.0f);
        for (size_t k = 0; k < kSkinBones; ++k)
            sum += avatar.skin_weights()[v][k] * Vec3(avatar.skinning_matrices()[avatar.skin_bones()[v][k]] *
                                                      Vec4(avatar.rest().positions[v], 1.0f));
        ASSERT_LT(glm::distance(sum, avatar.positions()[v]), kRoundingM);
    }
}

TEST(Avatar, NormalsAreUnitAndCloseToThoseOfThePosedSurface) {
    Avatar avatar = make_avatar();
    avatar.pose(lively(avatar), *Jobs::own(0));
    const size_t count = avatar.topology().vertex_count;
    const std::vector<Vec3> posed(avatar.positions().begin(),
                                  avatar.positions().begin() + std::ptrdiff_t(count));
    std::vector<Vec3> recomputed;
    compute_normals(posed, avatar.topology().indices, recomputed);
    double cosines = 0.0;
    for (size_t v = 0; v < count; ++v) {
        ASSERT_NEAR(glm::length(avatar.normals()[v]), 1.0f, 1e-4f);
        cosines += double(glm::dot(recomputed[v], avatar.normals()[v]));
    }
    EXPECT_GT(cosines / double(count), 0.99);  // 8 degrees on average, most of them in the bent joints
}

TEST(Avatar, DetailOneHasFourTimesTheTriangles) {
    AvatarDesc fine;
    fine.detail = 1;
    const Avatar coarse = make_avatar(), smooth = make_avatar(fine);
    EXPECT_EQ(smooth.rest().indices.size(), 4 * coarse.rest().indices.size());
    EXPECT_NEAR(height(smooth.positions()), height(coarse.positions()), 0.01f);
    for (size_t v = 0; v < smooth.skin_weights().size(); ++v) {
        float sum = 0.0f;
        for (const float w : smooth.skin_weights()[v]) sum += w;
        ASSERT_NEAR(sum, 1.0f, 1e-5f);
    }
}

TEST(Avatar, PoseThatIsNotFiniteIsRefusedAndNothingMoves) {
    Avatar avatar = make_avatar();
    const std::vector<Vec3> before = avatar.positions();
    Pose pose = standing(avatar);
    pose.time_ns = 5;
    pose.rotation[VFIT_BONE_LEFT_HAND].w = std::numeric_limits<float>::quiet_NaN();
    try {
        avatar.pose(pose, *Jobs::own(0));
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
    }
    EXPECT_EQ(avatar.positions(), before);
    EXPECT_EQ(avatar.time_ns(), 0);
}

TEST(Avatar, BadDescriptionIsRefused) {
    const auto refused = [](const AvatarDesc& desc, std::span<const float> shape, const Vec2& scale) {
        try {
            const Avatar avatar(body_model(), desc, shape, scale);
        } catch (const Error& error) {
            return error.code() == VFIT_ERROR_ARGUMENT;
        }
        return false;
    };
    AvatarDesc fine, steps;
    fine.detail = kCoarseBody + 1;
    steps.twist_steps = 0;
    std::vector<float> shape = body_model()->default_shape(VFIT_SEX_FEMALE);
    EXPECT_TRUE(refused(fine, {}, Vec2(1)));
    EXPECT_TRUE(refused(steps, {}, Vec2(1)));
    EXPECT_TRUE(refused({}, {}, Vec2(0, 1)));
    EXPECT_TRUE(refused({}, {}, Vec2(1, std::numeric_limits<float>::infinity())));
    EXPECT_TRUE(refused({}, std::span(shape).first(shape.size() - 1), Vec2(1)));
    shape[0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(refused({}, shape, Vec2(1)));
    EXPECT_THROW(Avatar(nullptr, {}, {}, Vec2(1)), Error);
}

}  // namespace
}  // namespace vfit
