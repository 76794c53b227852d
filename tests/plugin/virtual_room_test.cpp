// What stands and passes in the virtual room: furniture, a box, other people; and who is not there.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "depth_camera.h"
#include "furniture.h"
#include "solids.h"
#include "virtual_host.h"

namespace vfit::virtual_person {
namespace {

const SensorModel& kIdeal = *find_sensor_model("ideal");

CleanImage paint(const std::vector<Solid>& solids, float tilt_rad = 0.0f) {
    const DepthCamera camera(kIdeal, {1.0f, tilt_rad}, {5.0f, 0});
    CleanImage image;
    DepthCamera room(kIdeal, {1.0f, tilt_rad}, {5.0f, 0});
    room.render(nullptr, image);
    SolidPainter(kIdeal, camera.world_from_camera(), 1.0f).paint(solids, image);
    return image;
}

TEST(Solids, ABoxHasItsFrontWhereItStands) {
    const CleanImage image = paint({box({0, 1, -2}, {0.3f, 0.4f, 0.25f})});
    const size_t middle = 243 * 640 + 339;
    EXPECT_NEAR(image.depth_m[middle], 1.75f, 1e-5f);
    EXPECT_NEAR(image.cosine[middle], 1.0f, 1e-3f);
    size_t front = 0;
    for (const float d : image.depth_m) front += std::abs(d - 1.75f) < 1e-4f;
    const float expected = 0.6f * kIdeal.fx / 1.75f * 0.8f * kIdeal.fy / 1.75f;
    EXPECT_NEAR(float(front), expected, 0.02f * expected);
}

TEST(Solids, AnEllipsoidIsAsFarAsItsEquationSays) {
    const Vec3 centre(0.2f, 1.1f, -2.5f), half(0.3f, 0.5f, 0.2f);
    const CleanImage image = paint({ellipsoid(centre, half)});
    size_t seen = 0;
    for (uint32_t y = 0; y < kIdeal.height; ++y)
        for (uint32_t x = 0; x < kIdeal.width; ++x) {
            const float z = image.depth_m[size_t{y} * kIdeal.width + x];
            if (z > 2.9f || z == 0.0f) continue;
            const Vec3 p((float(x) - kIdeal.cx) / kIdeal.fx * z,
                         1.0f - (float(y) - kIdeal.cy) / kIdeal.fy * z, -z);
            if (p.y < 0.01f) continue;  // the floor
            ASSERT_NEAR(glm::length((p - centre) / half), 1.0f, 1e-3f) << x << ", " << y;
            ++seen;
        }
    EXPECT_GT(seen, 15000u);
}

TEST(Solids, ATurnedBoxShowsItsEdge) {
    const Solid turned = placed(box({0, 1, 0}, {0.2f, 0.2f, 0.2f}), 45.0f, {0, 0, -2});
    const CleanImage image = paint({turned});
    EXPECT_NEAR(image.depth_m[243 * 640 + 339], 2.0f - 0.2f * std::sqrt(2.0f), 2e-3f);
}

TEST(Furniture, NamesArePiecesOrAreRefused) {
    EXPECT_TRUE(is_furniture(""));
    EXPECT_TRUE(is_furniture("chair,rack,stool"));
    EXPECT_FALSE(is_furniture("chair,sofa"));
    EXPECT_FALSE(is_furniture("chair,,rack"));
    EXPECT_TRUE(make_furniture("", Vec3(0), 0).empty());
}

TEST(VirtualRoom, FurnitureIsSeenAndIsNobody) {
    TestHost host;
    const auto empty = host.run("virtual:sensor=ideal&frames=1&people=0");
    for (const char* piece : {"chair", "rack", "stool"}) {
        const auto frames =
            host.run(std::string("virtual:sensor=ideal&frames=2&people=0&furniture=") + piece);
        ASSERT_EQ(frames.size(), 2u);
        for (const Taken& f : frames) {
            EXPECT_TRUE(f.everybody.empty());
            EXPECT_EQ(f.pixels_of(0), f.user.size()) << piece << " has a label";
            EXPECT_EQ(f.meta.count("measures"), 0u) << "nobody has measures";
            EXPECT_EQ(f.meta.at("bodies"), "true");
            size_t nearer = 0;
            for (size_t i = 0; i < f.depth.size(); ++i) {
                ASSERT_LE(f.depth[i], empty.at(0).depth[i]);
                nearer += f.depth[i] < empty[0].depth[i];
            }
            EXPECT_GT(nearer, 1500u) << piece;
        }
    }
}

TEST(VirtualRoom, FurnitureStandsBesideThePersonWithoutTouchingThem) {
    TestHost host;
    const auto with = host.run("virtual:sensor=ideal&frames=1&furniture=chair,rack"),
               without = host.run("virtual:sensor=ideal&frames=1");
    EXPECT_EQ(with.at(0).user, without.at(0).user);
}

TEST(VirtualRoom, ThePersonSitsOnTheStool) {
    TestHost host;
    const auto frames =
        host.run("virtual:sensor=ideal&frames=31&rate=10&motion=sit&furniture=stool&distance=3");
    const auto hip_height = [](const Taken& f) {
        const float* p = f.joints[VFIT_JOINT_LEFT_HIP].position;
        return f.camera.floor_distance_m - p[1];
    };
    ASSERT_EQ(frames.size(), 31u);
    EXPECT_GT(hip_height(frames[0]), 0.75f);
    EXPECT_NEAR(hip_height(frames[30]), kStoolHeight_m + 0.09f, 0.02f);
    const auto hip_z = [](const Taken& f) { return f.joints[VFIT_JOINT_LEFT_HIP].position[2]; };
    EXPECT_GT(hip_z(frames[30]), hip_z(frames[0]) + 0.3f);
}

TEST(VirtualRoom, ABoxHidesThePersonForAboutASecond) {
    TestHost host;
    const auto frames = host.run("virtual:frames=60&rate=10&occluder=2.5&motion=sway&sensor=kinect_v1_320");
    const size_t whole = frames.at(0).pixels_of(1);
    ASSERT_GT(whole, 3000u);
    int hidden = 0;
    for (const Taken& f : frames) {
        ASSERT_EQ(f.everybody.count(1), 1u) << "who is hidden is still there";
        if (f.pixels_of(1) > whole / 20) continue;
        ++hidden;
        int seen = 0;
        for (const vfit_joint& j : f.joints) seen += j.state == VFIT_JOINT_MEASURED;
        EXPECT_LE(seen, 2) << "at frame " << f.meta.at("index");
    }
    EXPECT_GE(hidden, 6);
    EXPECT_LE(hidden, 16);
    EXPECT_LT(frames.at(30).pixels_of(1), whole / 100) << "in the middle of the second";
    EXPECT_GT(frames.back().pixels_of(1), whole / 2) << "the box has gone on";
}

TEST(VirtualRoom, AVisitorIsToldOnlyWhileTheyAreThere) {
    TestHost host;
    const auto frames =
        host.run("virtual:frames=100&rate=5&motion=visit&distance=3&sensor=kinect_v1_320&noise=0");
    ASSERT_EQ(frames.size(), 100u);
    int there = 0;
    for (const Taken& f : frames) {
        if (f.everybody.empty()) {
            EXPECT_LT(f.pixels_of(1), 1500u) << f.meta.at("index");
            EXPECT_EQ(f.meta.at("bodies"), "true");
        }
        there += !f.everybody.empty() && !(f.body.flags & VFIT_BODY_PARTLY_OUT_OF_VIEW);
    }
    EXPECT_TRUE(frames.front().everybody.empty());
    EXPECT_EQ(frames.front().pixels_of(1), 0u);
    EXPECT_TRUE(frames.back().everybody.empty());
    EXPECT_GT(there, 30) << "six seconds in full view";
    EXPECT_LT(there, 60);
}

TEST(VirtualRoom, ThreePeopleHaveLabelsAndJointsOfTheirOwn) {
    TestHost host;
    const auto frames = host.run("virtual:frames=2&people=3&distance=3&noise=0&clothing=0.02");
    for (const Taken& f : frames) {
        ASSERT_EQ(f.everybody.size(), 3u);
        for (const auto& [id, joints] : f.everybody) {
            EXPECT_GT(f.pixels_of(uint8_t(id)), 8000u);
            for (const vfit_joint_id j : {VFIT_JOINT_HEAD, VFIT_JOINT_NECK, VFIT_JOINT_TORSO}) {
                const Vec2 p = f.project(joints[size_t(j)]);
                EXPECT_EQ(f.user[size_t(std::lround(p.y)) * f.width + size_t(std::lround(p.x))], id)
                    << "joint " << j;
            }
        }
    }
}

TEST(VirtualRoom, BlackHairGivesNoReading) {
    TestHost host;
    const auto bare = host.run("virtual:frames=1&sensor=ideal&noise=0").at(0),
               hairy = host.run("virtual:frames=1&sensor=ideal&noise=0&black_hair=0.1").at(0);
    uint32_t top = 0, lost = 0;
    while (std::count(bare.user.begin() + top * bare.width, bare.user.begin() + (top + 1) * bare.width, 1) ==
           0)
        ++top;
    for (uint32_t y = 0; y < bare.height; ++y)
        for (uint32_t x = 0; x < bare.width; ++x) {
            const size_t i = size_t{y} * bare.width + x;
            if (bare.depth[i] == hairy.depth[i]) continue;
            EXPECT_EQ(hairy.depth[i], 0) << "nothing is behind it";
            EXPECT_EQ(bare.user[i], 1);
            EXPECT_EQ(hairy.user[i], 0);
            // 10 cm and no more, at the distance of the head.
            EXPECT_LT(float(y - top), 0.115f * bare.intrinsics.fy / bare.unproject(x, y).z);
            ++lost;
        }
    EXPECT_GT(lost, 100u);
}

TEST(VirtualRoom, TheFloorCanBeKeptSecret) {
    TestHost host;
    const auto frames = host.run("virtual:frames=1&floor=unknown&camera_height=1.4");
    EXPECT_EQ(frames.at(0).camera.floor_state, VFIT_FLOOR_DEFAULT);
    EXPECT_EQ(frames.at(0).camera.depth_unit_m, 0.001f);
}

}  // namespace
}  // namespace vfit::virtual_person
