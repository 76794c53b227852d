// Creases of the skin: parts that press into each other give way, everything else stays.
#include "avatar/creases.h"

#include <gtest/gtest.h>

#include <numeric>

#include "body_fixture.h"
#include "geometry/mesh_query.h"
#include "support/allocation_count.h"

namespace vfit {
namespace {

constexpr float kDeg = kPi / 180.0f;

AvatarDesc with_creases_opened() {
    AvatarDesc desc;
    desc.limbs_clear = true;
    return desc;
}

/// Arms down by arms_deg from the T-pose, legs turned inwards by legs_deg each.
Pose posed(const Avatar& avatar, float arms_deg, float legs_deg) {
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    for (const float side : {1.0f, -1.0f}) {
        const bool left = side > 0.0f;
        pose.rotation[left ? VFIT_BONE_LEFT_UPPER_ARM : VFIT_BONE_RIGHT_UPPER_ARM] =
            glm::angleAxis(-side * arms_deg * kDeg, Vec3(0, 0, 1));
        pose.rotation[left ? VFIT_BONE_LEFT_UPPER_LEG : VFIT_BONE_RIGHT_UPPER_LEG] =
            glm::angleAxis(-side * legs_deg * kDeg, Vec3(0, 0, 1));
    }
    return pose;
}

/// How close the skin of one thigh comes to the other's; negative: inside.
float gap_of_thighs(const Avatar& avatar) {
    const std::vector<uint32_t> right = triangles_of(avatar.topology(), BodyPart::kRightThigh);
    const MeshQuery query(avatar.positions(), right);
    float gap = INFINITY;
    for (size_t v = 0; v < avatar.topology().vertex_count; ++v) {
        // Below the crotch, where the thighs and the trunk are one surface.
        if (avatar.topology().parts[v] != BodyPart::kLeftThigh || avatar.rest().positions[v].y > 0.68f)
            continue;
        const auto nearest = query.closest(avatar.positions()[v]);
        const bool inside = glm::dot(avatar.positions()[v] - nearest.point, nearest.normal) < 0.0f;
        gap = std::min(gap, inside ? -nearest.distance : nearest.distance);
    }
    return gap;
}

TEST(Creases, ThighsThatPressIntoEachOtherGetRoomForCloth) {
    Avatar opened = make_avatar(with_creases_opened()), skinned = make_avatar();
    const auto jobs = Jobs::own(0);
    for (const float inwards : {2.0f, 4.0f, 6.0f}) {
        const Pose pose = posed(opened, 40.0f, inwards);
        opened.pose(pose, *jobs);
        skinned.pose(pose, *jobs);
        EXPECT_GT(gap_of_thighs(opened), 0.006f)
            << inwards << " degrees, as skinned " << gap_of_thighs(skinned) << " m";
    }
    EXPECT_LT(gap_of_thighs(skinned), 0.0f);
}

TEST(Creases, TheRestMeshStaysToTheBit) {
    for (const vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
        AvatarDesc desc;
        desc.sex = sex;
        const Avatar avatar = make_avatar(desc);
        std::vector<Vec3> places = avatar.rest().positions;
        std::vector<uint32_t> all(places.size());
        std::iota(all.begin(), all.end(), 0u);
        const Creases::Mesh mesh = avatar.creases().mesh_of(all, places);
        const std::vector<Mat4> identity(avatar.rig_bones().size(), Mat4(1.0f));
        avatar.creases().open(identity, mesh, places, *Jobs::own(0));
        for (size_t v = 0; v < places.size(); ++v) ASSERT_EQ(places[v], avatar.rest().positions[v]) << v;
    }
}

TEST(Creases, NothingMovesWhereNothingIsNear) {
    Avatar opened = make_avatar(with_creases_opened()), skinned = make_avatar();
    const auto jobs = Jobs::own(0);
    const Pose pose = posed(opened, 20.0f, -8.0f);
    opened.pose(pose, *jobs);
    skinned.pose(pose, *jobs);
    const BodyTopology& topology = opened.topology();
    for (size_t v = 0; v < topology.vertex_count; ++v) {
        const float way = glm::distance(opened.positions()[v], skinned.positions()[v]);
        const BodyPart part = topology.parts[v];
        const bool is_free =
            part == BodyPart::kLeftForearm || part == BodyPart::kRightShank || part == BodyPart::kHead;
        EXPECT_LE(way, is_free ? 0.0f : 0.012f) << v;  // in the armpit and at the crotch skin is near skin
    }
}

TEST(Creases, OpenWithoutAJump) {
    Avatar opened = make_avatar(with_creases_opened()), skinned = make_avatar();
    const auto jobs = Jobs::own(0);
    std::vector<Vec3> before;
    float largest = 0.0f;
    for (int step = 0; step <= 120; ++step) {
        const Pose pose = posed(opened, 30.0f + 0.25f * float(step), -2.0f + 0.05f * float(step));
        opened.pose(pose, *jobs);
        skinned.pose(opened.shown_pose(), *jobs);
        std::vector<Vec3> by(opened.positions().size());
        for (size_t v = 0; v < by.size(); ++v) by[v] = opened.positions()[v] - skinned.positions()[v];
        for (size_t v = 0; v < before.size(); ++v)
            largest = std::max(largest, glm::distance(by[v], before[v]));
        before = std::move(by);
    }
    EXPECT_LT(largest, 0.008f);  // a quarter of a degree moves skin at the armpit by 1 mm
}

TEST(Creases, AreTheSameOnOneThreadAndOnMany) {
    Avatar one = make_avatar(with_creases_opened()), many = make_avatar(with_creases_opened());
    const Pose pose = posed(one, 75.0f, 3.0f);
    one.pose(pose, *Jobs::own(0));
    many.pose(pose, *Jobs::own(3));
    EXPECT_EQ(one.positions(), many.positions());
}

TEST(Creases, OpenWithoutAllocating) {
    Avatar opened = make_avatar(with_creases_opened());
    const auto jobs = Jobs::own(0);
    opened.pose(posed(opened, 60.0f, 1.0f), *jobs);
    const Pose pose = posed(opened, 75.0f, 3.0f);
    const uint64_t before = test::allocations;
    opened.pose(pose, *jobs);
    EXPECT_EQ(test::allocations - before, 0u);
}

TEST(Creases, SeamCopiesStayWithTheirVertices) {
    Avatar opened = make_avatar(with_creases_opened());
    opened.pose(posed(opened, 75.0f, 3.0f), *Jobs::own(0));
    const BodyTopology& topology = opened.topology();
    for (size_t i = 0; i < topology.seam_sources.size(); ++i)
        EXPECT_EQ(opened.positions()[topology.vertex_count + i],
                  opened.positions()[topology.seam_sources[i]]);
}

}  // namespace
}  // namespace vfit
