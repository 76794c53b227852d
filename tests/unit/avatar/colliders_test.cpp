// The avatar's collision spheres and capsules, and what becomes of the scan's radii.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "body_fixture.h"
#include "core/error.h"
#include "geometry/mesh_query.h"

namespace vfit {
namespace {

std::vector<Collider> colliders_of(const Avatar& avatar) {
    std::vector<Collider> out;
    avatar.colliders(out);
    return out;
}

std::array<float, kPaperJointCount> all(float radius) {
    std::array<float, kPaperJointCount> radii;
    radii.fill(radius);
    return radii;
}

TEST(AvatarColliders, DefaultSpheresAreTheLargestInsideTheSkin) {
    const Avatar avatar = make_avatar();
    const MeshQuery skin(std::span(avatar.rest().positions).first(avatar.topology().vertex_count),
                         avatar.topology().indices);
    const std::vector<Collider> colliders = colliders_of(avatar);
    ASSERT_EQ(colliders.size(), size_t(kColliderCount));
    for (int j = 0; j < kPaperJointCount; ++j) {
        const Collider& sphere = colliders[static_cast<size_t>(j)];
        EXPECT_EQ(sphere.joint, j);
        EXPECT_FALSE(sphere.is_capsule());
        const bool palm = j == VFIT_JOINT_LEFT_HAND || j == VFIT_JOINT_RIGHT_HAND;  // some 2 cm thick
        EXPECT_GT(sphere.radius, palm ? 0.009f : 0.01f) << joint_name(j);
    }
    // The knee's joint in the rest mesh is the start of its bone.
    for (const AvatarBone& bone : avatar.rig_bones())
        if (bone.bone == VFIT_BONE_LEFT_LOWER_LEG) {
            EXPECT_NEAR(colliders[VFIT_JOINT_LEFT_KNEE].radius, -skin.signed_distance(bone.rest_head), 1e-5f);
        }
}

TEST(AvatarColliders, MeasuredRadiiAreCutToTheSkin) {
    Avatar avatar = make_avatar();
    const std::vector<Collider> inner = colliders_of(avatar);
    std::array<float, kPaperJointCount> radii = all(0.5f);
    radii[VFIT_JOINT_LEFT_KNEE] = 0.011f;
    radii[VFIT_JOINT_HEAD] = 0.0f;
    avatar.set_collider_radii(radii);
    const std::vector<Collider> cut = colliders_of(avatar);
    for (int j = 0; j < kPaperJointCount; ++j) {
        const auto i = static_cast<size_t>(j);
        EXPECT_EQ(cut[i].radius, j == VFIT_JOINT_LEFT_KNEE ? 0.011f : inner[i].radius) << joint_name(j);
    }
}

TEST(AvatarColliders, PaperModeTakesMeasuredRadiiAsTheyAre) {
    AvatarDesc desc;
    desc.paper_colliders = true;
    Avatar avatar = make_avatar(desc);
    const std::vector<Collider> inner = colliders_of(avatar);
    std::array<float, kPaperJointCount> radii = all(0.5f);
    radii[VFIT_JOINT_NECK] = 0.0f;
    avatar.set_collider_radii(radii);
    const std::vector<Collider> taken = colliders_of(avatar);
    EXPECT_EQ(taken[VFIT_JOINT_NECK].radius, inner[VFIT_JOINT_NECK].radius);
    EXPECT_EQ(taken[VFIT_JOINT_TORSO].radius, 0.5f);
}

TEST(AvatarColliders, CapsulesJoinTheSpheres) {
    Avatar avatar = make_avatar();
    Pose pose;
    pose.hips_position = Vec3(1, 0.8f, -2);
    pose.rotation[VFIT_BONE_LEFT_UPPER_LEG] = glm::angleAxis(-1.0f, Vec3(1, 0, 0));
    avatar.pose(pose, *Jobs::own(0));
    const std::vector<Collider> colliders = colliders_of(avatar);
    const Body joints = avatar.joints();
    bool thigh = false;
    for (const Collider& c : colliders) {
        EXPECT_EQ(c.center, joints.at(c.joint));
        EXPECT_EQ(c.radius, colliders[static_cast<size_t>(c.joint)].radius);
        if (!c.is_capsule()) continue;
        EXPECT_EQ(c.center_b, joints.at(c.joint_b));
        EXPECT_EQ(c.radius_b, colliders[static_cast<size_t>(c.joint_b)].radius);
        thigh = thigh || (c.joint == VFIT_JOINT_LEFT_HIP && c.joint_b == VFIT_JOINT_LEFT_KNEE);
    }
    EXPECT_TRUE(thigh);
}

TEST(AvatarColliders, RadiusThatIsNoLengthIsRefusedAndChangesNothing) {
    Avatar avatar = make_avatar();
    const float before = colliders_of(avatar)[VFIT_JOINT_HEAD].radius;
    for (const float bad :
         {-0.01f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        std::array<float, kPaperJointCount> radii = all(0.02f);
        radii[VFIT_JOINT_RIGHT_FOOT] = bad;
        try {
            avatar.set_collider_radii(radii);
            FAIL() << "accepted " << bad;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_ARGUMENT);
            EXPECT_NE(std::string(error.what()).find("RIGHT_FOOT"), std::string::npos);
        }
        EXPECT_EQ(colliders_of(avatar)[VFIT_JOINT_HEAD].radius, before);
    }
}

}  // namespace
}  // namespace vfit
