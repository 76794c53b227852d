// The floor plane from one depth image: whatever way the camera stands, and nothing where no floor is seen.
#include "track/floor_finder.h"

#include <gtest/gtest.h>

#include <random>

#include "room_scene.h"

namespace vfit {
namespace {

using testing::RoomScene;
using testing::standing_person;

double degrees_off(const Camera& a, const Camera& b) {
    return std::acos(std::min(1.0f, glm::dot(a.floor_normal, b.floor_normal))) * 180.0 / double(kPi);
}

/// One image; the camera as the finder leaves it.
bool find(RoomScene& scene, Camera& camera) {
    scene.render();
    const DepthImage image = scene.bare();
    DepthGrid grid;
    grid.run(image);
    camera = image.camera;
    FloorFinder finder;
    return finder.run(grid, camera);
}

/// Numbers from `low` to `high`, the same ones every time.
struct Draw {
    std::mt19937 random{1};
    float operator()(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    }
};

struct Stand {
    float height_m, tilt_deg, roll_deg;
};

class FloorOfCamera : public ::testing::TestWithParam<Stand> {};

TEST_P(FloorOfCamera, IsFoundWithinOneDegreeAndThreeCentimetresInOneImage) {
    RoomScene scene;
    scene.stand(GetParam().height_m, GetParam().tilt_deg, GetParam().roll_deg);
    scene.people.push_back(standing_person(0.1f, -2.7f));
    scene.side_x = 1.8f;
    Camera camera;
    ASSERT_TRUE(find(scene, camera));
    EXPECT_EQ(camera.floor_state, VFIT_FLOOR_ESTIMATED);
    EXPECT_LT(degrees_off(camera, scene.camera), 1.0);
    EXPECT_NEAR(camera.floor_distance_m, scene.camera.floor_distance_m, 0.03f);
}

INSTANTIATE_TEST_SUITE_P(Stands, FloorOfCamera,
                         ::testing::Values(Stand{1.0f, 0, 0}, Stand{0.4f, -8, 0}, Stand{0.6f, 0, 5},
                                           Stand{1.6f, 20, 0}, Stand{2.2f, 45, -6}, Stand{2.4f, 30, 0},
                                           Stand{1.0f, 0, 90}, Stand{1.4f, 12, -90}, Stand{0.8f, -5, 86},
                                           Stand{0.4f, -12, 0}, Stand{0.4f, 30, 0}, Stand{1.0f, 30, 0},
                                           Stand{2.2f, 30, 0}, Stand{2.2f, 15, 0}, Stand{0.4f, -20, 90},
                                           Stand{2.2f, 30, 90}, Stand{1.2f, 30, -90}, Stand{2.3f, 30, 33},
                                           Stand{1.2f, 5, -35}, Stand{1.5f, 10, 180}, Stand{2.2f, 25, 150}));

TEST(FloorFinder, ACameraThatLooksUpSeesNone) {
    for (const float roll : {0.0f, 90.0f}) {
        RoomScene scene;
        scene.stand(1.0f, -30, roll);
        scene.side_x = 1.5f;
        scene.people.push_back(standing_person(0.0f, -2.2f));
        Camera camera;
        EXPECT_FALSE(find(scene, camera)) << roll;
    }
}

TEST(FloorFinder, SaysSoWhereNoFloorIsInView) {
    RoomScene scene;
    scene.floor = false;
    scene.side_x = 1.5f;
    scene.people.push_back(standing_person(0.0f, -2.0f));
    Camera camera;
    EXPECT_FALSE(find(scene, camera));
    EXPECT_EQ(camera.floor_state, VFIT_FLOOR_DEFAULT);
    EXPECT_FLOAT_EQ(camera.floor_distance_m, 1.0f);
}

TEST(FloorFinder, DoesNotTakeATableForTheFloorBelowIt) {
    RoomScene scene;
    scene.stand(1.5f, 25, 0);
    scene.things.push_back({{-1.0f, 0.70f, -2.6f}, {0.8f, 0.74f, -1.2f}});
    Camera camera;
    ASSERT_TRUE(find(scene, camera));
    EXPECT_NEAR(camera.floor_distance_m, 1.5f, 0.03f);
}

TEST(FloorFinder, SeesAShinyFloorAmongTheMirroredRoom) {
    RoomScene scene;
    scene.stand(1.3f, 10, 0);
    scene.render();
    Camera camera = scene.camera;
    std::mt19937 random(1);
    for (size_t i = 0; i < scene.depth.size(); ++i) {
        if (scene.depth[i] == 0) continue;
        const auto u = float(i % camera.width), v = float(i / camera.width);
        const Vec3 p = camera.unproject(u, v, float(scene.depth[i]) * camera.depth_unit_m);
        if (std::abs(glm::dot(camera.floor_normal, p) + camera.floor_distance_m) > 0.02f) continue;
        // One reading in four is of the floor, one of a wall that is mirrored 1 m below it.
        const float lower = (camera.floor_distance_m + 1.0f) / camera.floor_distance_m;
        const uint32_t luck = random() % 4;
        if (luck != 0) scene.depth[i] = luck == 1 ? uint16_t(float(scene.depth[i]) * lower) : uint16_t(0);
    }
    const DepthImage image = scene.bare();
    DepthGrid grid;
    grid.run(image);
    camera = image.camera;
    FloorFinder finder;
    ASSERT_TRUE(finder.run(grid, camera));
    EXPECT_NEAR(camera.floor_distance_m, 1.3f, 0.03f);
    EXPECT_LT(degrees_off(camera, scene.camera), 1.0);
}

TEST(FloorFinder, ATableTopIsNoFloorWhereNoFloorIsInView) {
    RoomScene scene;
    scene.floor = false;
    scene.wall_z = 0.0f;
    scene.stand(1.4f, 25, 0);
    scene.things.push_back({{-0.3f, 0.69f, -1.8f}, {0.3f, 0.7f, -1.2f}});
    Camera camera;
    EXPECT_FALSE(find(scene, camera));
}

TEST(FloorFinder, APlaneThatCutsThroughWallsIsNoFloor) {
    // Strips of both walls, of a box and of the person lie on it.
    Draw from;
    for (int i = 0; i < 40; ++i) {
        RoomScene scene;
        scene.floor = false;
        scene.wall_z = from(-4.5f, -2.5f);
        scene.side_x = from(0.6f, 2.0f);
        scene.stand(from(0.4f, 1.6f), from(-12, 8), from(-30, 30));
        scene.people.push_back(standing_person(from(-0.4f, 0.4f), from(-2.4f, -1.4f)));
        const float x = from(-1.5f, -0.6f), z = from(-2.5f, -1.5f);
        scene.things.push_back({{x - 0.3f, 0, z - 0.3f}, {x + 0.3f, from(1.2f, 2.0f), z + 0.3f}});
        Camera camera;
        EXPECT_FALSE(find(scene, camera)) << i;
    }
}

TEST(FloorFinder, ALargeTableInFrontOfTheSensorIsNoFloor) {
    // It hides the floor. Beyond its edges the room goes on below it; planes that cut it at a slight angle
    // see nothing below them.
    Draw from;
    for (int i = 0; i < 40; ++i) {
        RoomScene scene;
        scene.floor = false;
        scene.wall_z = from(-2.8f, -2.2f);
        scene.stand(from(1.2f, 1.5f), from(12, 24), from(-8, 8));
        const float edge = from(-1.3f, -1.0f), top = from(0.68f, 0.76f);
        scene.things.push_back({{from(-1.2f, -0.8f), top - 0.04f, edge}, {from(0.3f, 1.2f), top, -0.4f}});
        for (float x = -0.7f; x < 1.0f; x += 1.0f)  // chairs
            scene.things.push_back({{x, 0, edge - 0.15f}, {x + 0.4f, from(0.8f, 1.0f), edge - 0.1f}});
        Camera camera;
        EXPECT_FALSE(find(scene, camera)) << i << ": " << camera.floor_distance_m;
    }
}

TEST(FloorFinder, AnImageOfAFewColumnsOrRowsIsSearchedToo) {
    for (const auto& [width, height] : {std::pair{1u, 240u}, {5u, 240u}, {320u, 1u}, {1u, 1u}, {320u, 5u}}) {
        RoomScene scene;
        scene.camera.width = width, scene.camera.height = height;
        scene.camera.cx = 0.5f * float(width - 1), scene.camera.cy = 0.5f * float(height - 1);
        scene.stand(1.0f, 20, 0);
        Camera camera;
        const bool found = find(scene, camera);
        EXPECT_NEAR(camera.floor_distance_m, 1.0f, 0.1f) << width << "x" << height << " " << found;
    }
}

TEST(FloorFinder, LetsAFloorGoWhenAnotherSideIsUp) {
    RoomScene scene;
    scene.side_x = 1.2f;
    scene.render();
    DepthImage image = scene.bare();
    DepthGrid grid;
    grid.run(image);
    FloorFinder finder;
    ASSERT_TRUE(finder.run(grid, image.camera));
    image.camera.floor_state = VFIT_FLOOR_DEFAULT;
    image.camera.floor_normal = Vec3(0, 1, 0);
    EXPECT_FALSE(finder.run(grid, image.camera));
    EXPECT_FALSE(finder.found());
    EXPECT_EQ(image.camera.floor_state, VFIT_FLOOR_DEFAULT);
}

TEST(FloorFinder, LeavesAFloorAloneThatIsGiven) {
    RoomScene scene;
    scene.render();
    DepthImage image = scene.bare();
    set_floor(image.camera, 1.02f, 0.01f, 0.0f, VFIT_FLOOR_GIVEN);
    const Camera given = image.camera;
    DepthGrid grid;
    grid.run(image);
    FloorFinder finder;
    finder.run(grid, image.camera);
    EXPECT_EQ(image.camera.floor_distance_m, given.floor_distance_m);
    EXPECT_EQ(image.camera.floor_normal, given.floor_normal);
    EXPECT_EQ(image.camera.floor_state, VFIT_FLOOR_GIVEN);
}

TEST(FloorFinder, RemembersTheFloorWhileItIsHiddenAndFollowsACameraThatIsTurned) {
    RoomScene scene;
    FloorFinder finder;
    DepthGrid grid;
    const auto look = [&](uint32_t seed, Camera& camera) {
        scene.render(seed);
        const DepthImage image = scene.bare();
        camera = image.camera;
        grid.run(image);
        return finder.run(grid, camera);
    };
    Camera camera;
    ASSERT_TRUE(look(1, camera));
    scene.things.push_back({{-3.0f, 0.0f, -1.0f}, {3.0f, 3.0f, -0.9f}});  // somebody before the lens
    EXPECT_FALSE(look(2, camera));
    EXPECT_EQ(camera.floor_state, VFIT_FLOOR_ESTIMATED);
    EXPECT_NEAR(camera.floor_distance_m, 1.0f, 0.03f);
    scene.things.clear();
    scene.stand(1.3f, 15, 0);
    for (uint32_t i = 0; i < 30; ++i) look(3 + i, camera);
    EXPECT_LT(degrees_off(camera, scene.camera), 0.5);
    EXPECT_NEAR(camera.floor_distance_m, 1.3f, 0.015f);
}

}  // namespace
}  // namespace vfit
