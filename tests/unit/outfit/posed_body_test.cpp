// The body as a solid: which of a prop's points are moved out of it.
#include "outfit/posed_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/mesh_query.h"
#include "people.h"

namespace vfit {
namespace {

using namespace test;

constexpr float kRoom_m = 0.012f;

std::vector<Vec3> points_about(std::span<const Vec3> skin, size_t count) {
    Bounds box;
    for (const Vec3& p : skin) box.add(p);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> share(-0.05f, 1.05f);
    std::vector<Vec3> out;
    for (size_t i = 0; i < count; ++i)
        out.push_back(glm::mix(box.low, box.high, Vec3(share(random), share(random), share(random))));
    return out;
}

const Bounds kEverywhere{Vec3(-10.0f), Vec3(10.0f)};

class PosedBodyTest : public testing::Test {
protected:
    std::unique_ptr<Jobs> jobs = Jobs::own(0);
    Person person{VFIT_SEX_FEMALE};
    std::vector<Vec3> skin{person.wearer.positions().begin(), person.wearer.positions().end()};
    const std::vector<uint32_t>& indices = person.wearer.indices();
};

TEST_F(PosedBodyTest, TheClosestPointIsThatOfAnotherSearch) {
    const MeshQuery query(skin, indices);
    TriangleGroups groups(skin, indices);
    groups.move(skin, *jobs);
    int inside = 0;
    for (const Vec3& p : points_about(skin, 3000)) {
        const TriangleGroups::Closest on = groups.closest(p, INFINITY);
        ASSERT_NEAR(std::abs(on.distance), query.closest(p).distance, 1e-5f);
        ASSERT_NEAR(glm::distance(on.point, p), std::abs(on.distance), 1e-5f);
        // Skin inside of skin, as where lips meet, is not what is asked here.
        if (std::abs(on.distance) < 0.002f) continue;
        EXPECT_EQ(on.distance < 0.0f, query.inside(p)) << p.x << " " << p.y << " " << p.z;
        inside += on.distance < 0.0f;
        const TriangleGroups::Closest near_by = groups.closest(p, 0.9f * std::abs(on.distance));
        EXPECT_TRUE(std::isinf(near_by.distance));
    }
    EXPECT_GT(inside, 100);
}

TEST_F(PosedBodyTest, PointsThatMoveIntoTheSkinAreKeptOffItFromStepToStep) {
    const MeshQuery query(skin, indices);
    PosedBody body(indices), fresh(indices);
    body.see(skin, {});
    fresh.see(skin, {});
    const std::vector<Vec3> start = points_about(skin, 500);
    PosedBody::Points points;
    std::vector<Vec3> places = start;
    for (int step = 0; step < 40; ++step) {
        for (size_t i = 0; i < places.size(); ++i)
            places[i] = start[i] + 0.15f * std::sin(0.3f * float(step)) * Vec3(1.0f, 0.2f, -0.6f);
        body.move(places, kRoom_m, kEverywhere, points, *jobs);
        // The same as when nothing is known of the steps before.
        PosedBody::Points anew;
        fresh.move(places, kRoom_m, kEverywhere, anew, *jobs);
        for (size_t i = 0; i < places.size(); ++i) {
            ASSERT_LT(glm::distance(points.at[i], anew.at[i]), 1e-6f) << step;
            if (query.signed_distance(places[i]) > kRoom_m + 1e-5f) {
                ASSERT_EQ(points.at[i], places[i]) << step;
            }
        }
    }
}

TEST_F(PosedBodyTest, SkinThatMovesAwayAndComesBackIsMetAgain) {
    PosedBody body(indices);
    const std::vector<Vec3> places = points_about(skin, 500);
    PosedBody::Points points, first;
    std::vector<Vec3> moved = skin;
    body.see(moved, {});
    body.move(places, kRoom_m, kEverywhere, first, *jobs);
    for (const float aside : {0.0f, 0.01f, 0.3f, 1.5f, 0.2f, 0.0f}) {
        for (size_t i = 0; i < skin.size(); ++i) moved[i] = skin[i] + Vec3(aside, 0.0f, 0.0f);
        body.see(moved, {});
        body.move(places, kRoom_m, kEverywhere, points, *jobs);
    }
    for (size_t i = 0; i < places.size(); ++i) EXPECT_LT(glm::distance(points.at[i], first.at[i]), 1e-6f);
    // Not where no cloth is.
    body.move(places, kRoom_m, {Vec3(5.0f), Vec3(6.0f)}, points, *jobs);
    EXPECT_EQ(points.at, places);
}

TEST_F(PosedBodyTest, SpheresAndCapsulesAreSolidsToo) {
    Collider ball, limb;
    ball.radius = 0.2f;
    limb.joint_b = 0;
    limb.center = Vec3(0.15f, 0.0f, 0.0f), limb.center_b = Vec3(0.8f, 0.0f, 0.0f);
    limb.radius = limb.radius_b = 0.1f;
    PosedBody body({});
    const std::vector<Collider> colliders{ball, limb};
    body.see({}, colliders);
    const std::vector<Vec3> places{
        {-0.1f, 0.01f, 0.0f}, {0.5f, 0.05f, 0.0f}, {0.5f, 0.3f, 0.0f}, {0.19f, 0.02f, 0.03f}};
    PosedBody::Points points;
    body.move(places, kRoom_m, kEverywhere, points, *jobs);
    EXPECT_NEAR(glm::length(points.at[0]), 0.2f + kRoom_m, 1e-5f);
    EXPECT_NEAR(points.at[1].y, 0.1f + kRoom_m, 1e-5f);
    EXPECT_EQ(points.at[2], places[2]);
    EXPECT_GE(glm::length(points.at[3]), 0.2f + kRoom_m - 1e-4f) << "out of both";
    EXPECT_GE(std::hypot(points.at[3].y, points.at[3].z), 0.1f + kRoom_m - 1e-4f);
}

}  // namespace
}  // namespace vfit
