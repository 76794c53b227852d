// The user map on scenes that are known by construction: people are found and keep their numbers, furniture
// is not.
#include "track/people_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "people_player.h"

namespace vfit {
namespace {

using testing::kFrame_ns;
using testing::People;
using testing::RoomScene;
using testing::standing_person;

TEST(PeopleMap, FindsOnePersonInTheFirstImageWithoutCalibration) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.2f, -2.8f));
    People people;
    const auto regions = people.see(scene);
    ASSERT_EQ(regions.size(), 1u);
    EXPECT_GT(people.iou(scene), 0.95);
    EXPECT_NEAR(regions[0].height_m, 1.72f, 0.04f);
    EXPECT_NEAR(regions[0].centre.x, 0.2f, 0.05f);
    EXPECT_NEAR(regions[0].centre.z, -2.7f, 0.15f);
    EXPECT_EQ(regions[0].out_of_view, 0u);
    EXPECT_EQ(people.map.camera().floor_state, VFIT_FLOOR_ESTIMATED);
}

TEST(PeopleMap, WhoStandsBehindAThingIsFoundAgainWhenItHasGone) {
    // The wall is out of the sensor's range, so that the thing is the first that is ever seen there.
    RoomScene scene;
    scene.wall_z = 0.0f;
    scene.people.push_back(standing_person(0.0f, -3.0f));
    People people;
    for (int i = 0; i < 15; ++i) people.see(scene);
    ASSERT_EQ(people.map.camera().floor_state, VFIT_FLOOR_ESTIMATED);
    const uint8_t before = people.label_of(scene, 1);
    ASSERT_NE(before, 0);
    for (int i = 0; i < 45; ++i) {  // slides from left to right, a second and a half before the person
        const float x = -1.3f + 0.05f * float(i);
        scene.things = {testing::Block{{x - 0.6f, 0, -2.3f}, {x + 0.6f, 2.1f, -2.1f}}};
        people.see(scene);
    }
    scene.things.clear();
    for (int i = 0; i < 5; ++i) people.see(scene);
    EXPECT_GT(people.iou(scene), 0.9);
    EXPECT_EQ(people.label_of(scene, 1), before);
}

TEST(PeopleMap, TakesImagesOfAnyShapeOneAfterTheOther) {
    PeopleMap map;
    int64_t time_ns = 0;
    for (const auto& [width, height] : {std::pair{320u, 240u},
                                        {240u, 320u},
                                        {16384u, 1u},
                                        {1000u, 2u},
                                        {1u, 1u},
                                        {1u, 500u},
                                        {320u, 240u}}) {
        std::vector<uint16_t> depth(size_t(width) * height, 2000);
        std::vector<uint8_t> users(depth.size(), 9);
        DepthImage image;
        image.depth = depth.data();
        image.camera.width = width, image.camera.height = height;
        image.camera.fx = image.camera.fy = 285.0f;
        image.camera.cx = 0.5f * float(width), image.camera.cy = 0.5f * float(height);
        for (int frame = 0; frame < 3; ++frame) {
            EXPECT_EQ(map.run(image, time_ns += kFrame_ns, users.data()).size(), 0u)
                << width << " x " << height;
            EXPECT_EQ(users.front() | users.back(), 0);
        }
    }
}

TEST(PeopleMap, ASourceThatStartsAgainIsSeenAfresh) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.2f, -2.8f));
    People people;
    for (const int64_t start : {int64_t(0), std::numeric_limits<int64_t>::max() - 10 * kFrame_ns,
                                std::numeric_limits<int64_t>::min(), int64_t(5) * kFrame_ns}) {
        people.time_ns = start;
        scene.render(1);
        people.users.resize(scene.depth.size());
        for (int frame = 0; frame < 3; ++frame) {
            people.time_ns += kFrame_ns;
            ASSERT_EQ(people.map.run(scene.bare(), people.time_ns, people.users.data()).size(), 1u) << start;
        }
    }
}

TEST(PeopleMap, KeepsTheFeet) {
    RoomScene scene;
    scene.stand(1.5f, 15, 0);
    scene.people.push_back(standing_person(0.0f, -2.8f));
    People people;
    for (int i = 0; i < 5; ++i) people.see(scene);
    size_t feet = 0, found = 0;
    const Mat4 world = scene.camera.world_from_camera();
    for (uint32_t v = 0; v < 240; ++v)
        for (uint32_t u = 0; u < 320; ++u) {
            const size_t i = size_t(v) * 320 + u;
            if (!scene.truth[i]) continue;
            const Vec3 p = scene.camera.unproject(float(u), float(v), float(scene.depth[i]) * 0.001f);
            if (transform_point(world, p).y > 0.1f) continue;
            ++feet;
            found += people.users[i] != 0;
        }
    EXPECT_GT(double(found), 0.9 * double(feet));
}

TEST(PeopleMap, WorksWithTheCameraOnItsSide) {
    for (const float roll : {90.0f, -90.0f}) {
        RoomScene scene;
        scene.stand(1.1f, 5, roll);
        scene.people.push_back(standing_person(0.0f, -2.4f));
        People people;
        const auto regions = people.see(scene);
        ASSERT_EQ(regions.size(), 1u) << roll;
        EXPECT_GT(people.iou(scene), 0.93);
        EXPECT_NEAR(regions[0].height_m, 1.72f, 0.05f);
    }
}

TEST(PeopleMap, ReportsNobodyInARoomWithFurniture) {
    RoomScene scene;
    scene.side_x = 1.6f;
    scene.things = {
        {{-1.2f, 0.0f, -2.6f}, {-0.7f, 1.5f, -2.1f}},  // cupboard
        {{0.2f, 0.4f, -2.4f}, {0.65f, 0.46f, -2.0f}},  // chair: seat, back, legs
        {{0.2f, 0.46f, -2.4f}, {0.65f, 0.95f, -2.36f}},
        {{0.22f, 0.0f, -2.04f}, {0.25f, 0.4f, -2.01f}},
        {{0.6f, 0.0f, -2.04f}, {0.63f, 0.4f, -2.01f}},
        {{-0.22f, 0.0f, -2.52f}, {-0.18f, 1.7f, -2.48f}},  // coat rack: pole, coat
        {{-0.38f, 1.0f, -2.6f}, {-0.02f, 1.6f, -2.4f}},
        {{-1.6f, 0.0f, -3.7f}, {1.0f, 2.2f, -3.68f}},  // curtain
    };
    People people;
    for (int i = 0; i < 5; ++i) EXPECT_EQ(people.see(scene).size(), 0u);
}

TEST(PeopleMap, PeopleWhoCrossKeepTheirNumbers) {
    RoomScene scene;
    scene.people.resize(2);
    People people;
    uint8_t first = 0, second = 0;
    for (int i = 0; i <= 60; ++i) {
        const float x = -0.9f + 0.03f * float(i);
        scene.people[0] = standing_person(x, -2.2f);
        scene.people[1] = standing_person(-x, -2.9f);
        people.see(scene);
        if (i == 0) {
            first = people.label_of(scene, 1);
            second = people.label_of(scene, 2);
            ASSERT_NE(first, 0);
            ASSERT_NE(second, 0);
            ASSERT_NE(first, second);
        }
    }
    EXPECT_EQ(people.label_of(scene, 1), first);
    EXPECT_EQ(people.label_of(scene, 2), second);
}

TEST(PeopleMap, PeopleWhoTouchStayTwo) {
    RoomScene scene;
    scene.people.resize(2);
    People people;
    for (int i = 0; i < 30; ++i) {
        const float x = 0.7f - 0.014f * float(i);  // to an overlap of the arms
        scene.people[0] = standing_person(-x, -2.5f);
        scene.people[1] = standing_person(x, -2.5f);
        EXPECT_EQ(people.see(scene).size(), 2u) << i;
    }
    EXPECT_GT(people.iou(scene, 1), 0.85);
    EXPECT_GT(people.iou(scene, 2), 0.85);
}

TEST(PeopleMap, TwoWhoTouchInTheFirstImageAreTwo) {
    RoomScene scene;
    scene.people = {standing_person(-0.29f, -2.8f), standing_person(0.29f, -2.8f)};
    People people;
    EXPECT_EQ(people.see(scene).size(), 2u);
    EXPECT_GT(people.iou(scene, 1), 0.85);
}

TEST(PeopleMap, WhoComesBackWithinTwoSecondsIsTheSame) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.3f, -2.8f));
    People people;
    uint32_t id = 0;
    for (int i = 0; i < 10; ++i) id = people.see(scene)[0].id;
    scene.people.clear();
    for (int i = 0; i < 50; ++i) EXPECT_EQ(people.see(scene).size(), 0u);
    scene.people.push_back(standing_person(-0.3f, -2.8f));
    ASSERT_EQ(people.see(scene).size(), 1u);
    EXPECT_EQ(people.map.run(scene.bare(), people.time_ns + 1, people.users.data())[0].id, id);
    scene.people.clear();
    for (int i = 0; i < 100; ++i) people.see(scene);
    scene.people.push_back(standing_person(0.3f, -2.8f));
    ASSERT_EQ(people.see(scene).size(), 1u);
    EXPECT_NE(people.map.run(scene.bare(), people.time_ns + 1, people.users.data())[0].id, id)
        << "three seconds later";
}

TEST(PeopleMap, ABoxBeforeThePersonForASecondDoesNotChangeTheNumber) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.0f, -2.8f));
    People people;
    uint32_t id = 0;
    for (int i = 0; i < 10; ++i) id = people.see(scene)[0].id;
    scene.things.push_back({{-0.5f, 0.0f, -1.7f}, {0.5f, 1.9f, -1.6f}});
    for (int i = 0; i < 30; ++i) people.see(scene);
    scene.things.clear();
    for (int i = 0; i < 5; ++i) people.see(scene);
    EXPECT_EQ(people.label_of(scene, 1), id);
    EXPECT_GT(people.iou(scene), 0.95);
}

TEST(PeopleMap, SaysWhichPartsAreOutOfView) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.0f, -1.4f));
    People people;
    auto regions = people.see(scene);
    ASSERT_EQ(regions.size(), 1u);
    EXPECT_TRUE(regions[0].out_of_view & kOutOfViewFeet);
    scene.people[0] = standing_person(-1.45f, -2.8f);  // x grows to the image's right
    People again;
    regions = again.see(scene);
    ASSERT_EQ(regions.size(), 1u);
    EXPECT_EQ(regions[0].out_of_view, uint32_t(kOutOfViewLeft));
    scene.people[0] = standing_person(1.45f, -2.8f);
    People once_more;
    regions = once_more.see(scene);
    ASSERT_EQ(regions.size(), 1u);
    EXPECT_EQ(regions[0].out_of_view, uint32_t(kOutOfViewRight));
    scene.stand(0.5f, 0, 0);
    scene.people[0] = standing_person(0.0f, -2.2f);
    People headless;
    regions = headless.see(scene);
    ASSERT_EQ(regions.size(), 1u);
    EXPECT_EQ(regions[0].out_of_view, uint32_t(kOutOfViewTop));
}

TEST(PeopleMap, ASegmentedImageNeedsNoFloor) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.0f, -2.5f));
    scene.render();
    for (size_t i = 0; i < scene.depth.size(); ++i)
        if (!scene.truth[i]) scene.depth[i] = 0;
    PeopleMap map;
    std::vector<uint8_t> users(scene.depth.size());
    ASSERT_EQ(map.run(scene.bare(), kFrame_ns, users.data()).size(), 1u);
    EXPECT_EQ(map.camera().floor_state, VFIT_FLOOR_DEFAULT);
    size_t missed = 0, all = 0;
    for (size_t i = 0; i < users.size(); ++i) {
        all += scene.truth[i] != 0;
        missed += scene.truth[i] != 0 && !users[i];
    }
    EXPECT_LT(missed, all / 100);
}

TEST(PeopleMap, AnEmptySceneTakesAwayWhatThePersonTouches) {
    RoomScene scene;
    scene.things.push_back({{0.15f, 0.0f, -2.95f}, {1.2f, 1.0f, -2.65f}});  // a counter beside the person
    scene.render();
    People people;
    people.map.learn_background(scene.bare());
    scene.people.push_back(standing_person(0.0f, -2.8f));
    ASSERT_EQ(people.see(scene).size(), 1u);
    EXPECT_GT(people.iou(scene), 0.93);
}

TEST(PeopleMap, WhatIsRejectedDoesNotComeBack) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.0f, -2.8f));  // a shop-window dummy
    People people;
    const auto regions = people.see(scene);
    ASSERT_EQ(regions.size(), 1u);
    people.map.reject(regions[0].id);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(people.see(scene).size(), 0u);
}

/// The second of two who touch in the first image, who may be a part of the first.
PersonRegion part_of_two(std::span<const PersonRegion> regions) {
    for (const PersonRegion& region : regions)
        if (region.part_of) return region;
    return {};
}

TEST(PeopleMap, APartThatIsNoPersonGoesBackToTheWhole) {
    RoomScene scene;
    scene.people = {standing_person(-0.29f, -2.8f), standing_person(0.29f, -2.82f)};
    People people;
    const PersonRegion part = part_of_two(people.see(scene));
    ASSERT_NE(part.id, 0u);
    people.map.rejoin(part.id);
    for (int i = 0; i < 30; ++i) {
        const auto regions = people.see(scene);
        ASSERT_EQ(regions.size(), 1u) << i;
        EXPECT_EQ(regions[0].id, part.part_of);
        EXPECT_GT(people.recall(scene, 1), 0.9);
        EXPECT_EQ(people.label_of(scene, 2), part.part_of);
        EXPECT_GT(people.recall(scene, 2), 0.9);
    }
    for (int i = 0; i < 60; ++i) people.see(scene);
    EXPECT_EQ(people.see(scene).size(), 2u);  // it is looked at anew
}

TEST(PeopleMap, WhoIsConfirmedIsNoPart) {
    RoomScene scene;
    scene.people = {standing_person(-0.29f, -2.8f), standing_person(0.29f, -2.82f)};
    People people;
    const PersonRegion part = part_of_two(people.see(scene));
    ASSERT_NE(part.id, 0u);
    people.map.confirm(part.id);
    const auto regions = people.see(scene);
    ASSERT_EQ(regions.size(), 2u);
    EXPECT_EQ(part_of_two(regions).id, 0u);
    people.map.rejoin(part.id);  // has no such part
    EXPECT_EQ(people.see(scene).size(), 2u);
}

TEST(PeopleMap, AWallBetweenArmAndTrunkIsNotThePersons) {
    RoomScene scene;
    scene.wall_z = -3.2f;
    scene.people.resize(1);
    People people;
    for (int i = 0; i < 60; ++i) {  // elbows swing back, almost to the wall
        const float swing = std::sin(0.9f * float(i));
        const Vec3 elbow(0.40f + 0.05f * swing, 1.15f, 0.3f * swing), hand(0.16f, 0.98f, 0.02f);
        scene.people[0] = placed(
            testing::upper_body() + testing::standing_legs() + testing::arms(elbow, hand), 0.0f, -2.8f);
        people.see(scene);
        if (i >= 5) {
            EXPECT_GT(people.iou(scene), 0.7) << i;
        }
    }
}

TEST(PeopleMap, RejectingNobodyChangesNothing) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.0f, -2.8f));
    People told, untold;
    for (const uint32_t nobody : {0u, 7u, 255u, 1000u}) {
        told.map.reject(nobody);
        const auto regions = told.see(scene);
        ASSERT_EQ(regions.size(), 1u);
        EXPECT_EQ(regions[0].id, untold.see(scene)[0].id);
        EXPECT_EQ(told.users, untold.users);
    }
    told.map.reset();
    told.map.reject(0);
    EXPECT_EQ(told.see(scene).size(), 1u);
}

}  // namespace
}  // namespace vfit
