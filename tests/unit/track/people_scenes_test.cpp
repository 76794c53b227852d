// The user map where it is hard: people at furniture and walls, close to each other, with things in their
// hands, and things that have a person's shape.
#include <gtest/gtest.h>

#include "people_player.h"

namespace vfit {
namespace {

using testing::kFrame_ns;
using testing::People;
using testing::placed;
using testing::reaching_person;
using testing::RoomScene;
using testing::sitting_person;
using testing::standing_person;

/// A second and a half before the people come.
void show_empty(RoomScene& scene, People& people) {
    const auto away = std::move(scene.people);
    scene.people.clear();
    for (int i = 0; i < 45; ++i) EXPECT_EQ(people.see(scene).size(), 0u);
    scene.people = away;
}

TEST(HardScene, TenCentimetresBeforeAWall) {
    RoomScene scene;
    scene.wall_z = -2.8f;
    scene.people.push_back(standing_person(0.1f, -2.55f));  // the back at -2.7 m
    People people;
    for (int i = 0; i < 5; ++i) ASSERT_EQ(people.see(scene).size(), 1u) << i;
    EXPECT_GT(people.iou(scene), 0.95);
}

TEST(HardScene, OnAChair) {
    RoomScene scene;
    scene.things = {{{-0.25f, 0.41f, -2.85f}, {0.25f, 0.45f, -2.35f}},  // seat
                    {{-0.25f, 0.45f, -2.9f}, {0.25f, 0.95f, -2.86f}},   // back
                    {{-0.24f, 0.0f, -2.4f}, {-0.2f, 0.41f, -2.36f}},
                    {{0.2f, 0.0f, -2.4f}, {0.24f, 0.41f, -2.36f}}};
    scene.people.push_back(sitting_person(0.0f, -2.65f));
    People people;
    for (int i = 0; i < 5; ++i) ASSERT_EQ(people.see(scene).size(), 1u) << i;
    EXPECT_GT(people.recall(scene), 0.97);
    EXPECT_GT(people.iou(scene), 0.75) << "the chair is taken along, and nothing else";
    People again;
    show_empty(scene, again);
    for (int i = 0; i < 5; ++i) ASSERT_EQ(again.see(scene).size(), 1u) << i;
    EXPECT_GT(again.iou(scene), 0.93);
}

TEST(HardScene, HandsOnATable) {
    RoomScene scene;
    scene.stand(1.3f, 8, 0);
    scene.things = {{{-0.6f, 0.72f, -2.35f}, {0.6f, 0.76f, -1.75f}},
                    {{-0.58f, 0.0f, -1.8f}, {-0.53f, 0.72f, -1.75f}},
                    {{0.53f, 0.0f, -1.8f}, {0.58f, 0.72f, -1.75f}}};
    scene.people.push_back(reaching_person(0.0f, -2.5f, {0.2f, 0.80f, 0.35f}));
    People people;
    for (int i = 0; i < 5; ++i) ASSERT_EQ(people.see(scene).size(), 1u) << i;
    EXPECT_GT(people.recall(scene), 0.75) << "all but the legs below the table top";
    People again;
    show_empty(scene, again);
    for (int i = 0; i < 5; ++i) ASSERT_EQ(again.see(scene).size(), 1u) << i;
    EXPECT_GT(again.iou(scene), 0.93);
}

TEST(HardScene, BehindALowTableThatHidesTheFeet) {
    RoomScene scene;
    scene.things.push_back({{-0.7f, 0.0f, -2.45f}, {0.7f, 0.45f, -1.9f}});
    scene.people.push_back(standing_person(0.0f, -2.75f));
    People people;
    for (int i = 0; i < 5; ++i) ASSERT_EQ(people.see(scene).size(), 1u) << i;
    EXPECT_GT(people.iou(scene), 0.9);
}

TEST(HardScene, AtATableThatTouchesTheTrunk) {
    RoomScene scene;
    scene.stand(1.4f, 8, 0);
    scene.things = {{{-0.8f, 0.70f, -2.34f}, {0.8f, 0.74f, -1.6f}},  // trunk to -2.35 m
                    {{-0.78f, 0.0f, -1.65f}, {-0.73f, 0.70f, -1.6f}},
                    {{0.73f, 0.0f, -1.65f}, {0.78f, 0.70f, -1.6f}}};
    scene.people.push_back(standing_person(0.0f, -2.5f));
    People people;
    for (int i = 0; i < 5; ++i) ASSERT_EQ(people.see(scene).size(), 1u) << i;
    EXPECT_GT(people.recall(scene), 0.6) << "the upper body";
    EXPECT_GT(people.iou(scene), 0.6) << "without the table";
}

TEST(HardScene, InTrousersThatSendBackNoLight) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.1f, -2.6f));
    People people;
    for (int i = 1; i < 10; ++i) {
        scene.render(uint32_t(i));
        people.users.resize(scene.depth.size());
        const Mat4 world = scene.camera.world_from_camera();
        for (uint32_t v = 0; v < scene.camera.height; ++v)
            for (uint32_t u = 0; u < scene.camera.width; ++u) {
                const size_t k = size_t(v) * scene.camera.width + u;
                const float z = float(scene.depth[k]) * scene.camera.depth_unit_m;
                const float y = transform_point(world, scene.camera.unproject(float(u), float(v), z)).y;
                if (scene.truth[k] && y < 0.9f) scene.depth[k] = 0;
            }
        ASSERT_EQ(people.map.run(scene.bare(), i * kFrame_ns, people.users.data()).size(), 1u) << i;
    }
}

TEST(HardScene, WithABoxInTheArms) {
    RoomScene scene;
    scene.people.push_back(reaching_person(0.0f, -2.6f, {0.2f, 1.0f, 0.35f}));
    scene.things.push_back({{-0.2f, 0.95f, -2.4f}, {0.2f, 1.25f, -2.1f}});
    People people;
    for (int i = 0; i < 5; ++i) ASSERT_EQ(people.see(scene).size(), 1u) << i;
    EXPECT_GT(people.recall(scene), 0.97);
}

TEST(HardScene, AChildHandInHandWithAnAdult) {
    RoomScene scene;
    // The child is 1.07 m tall; their hands meet at x = -0.1.
    scene.people = {standing_person(0.22f, -2.6f), standing_person(-0.28f, -2.55f, 0.62f)};
    People people;
    for (int i = 0; i < 15; ++i) people.see(scene);
    EXPECT_EQ(people.see(scene).size(), 2u);
    EXPECT_GT(people.iou(scene, 1), 0.9);
    EXPECT_GT(people.iou(scene, 2), 0.85);
}

TEST(HardScene, TwoWhoEmbraceAndPartKeepTheirNumbers) {
    RoomScene scene;
    scene.people.resize(2);
    People people;
    const auto see_at = [&](float half) {
        scene.people[0] = standing_person(-half, -2.55f);
        scene.people[1] = standing_person(half, -2.45f);
        people.see(scene);
    };
    uint8_t first = 0, second = 0;
    for (int i = 0; i <= 30; ++i) {
        see_at(0.6f - 0.016f * float(i));  // to 0.12 m: trunks overlap
        if (i == 0) first = people.label_of(scene, 1), second = people.label_of(scene, 2);
    }
    ASSERT_NE(first, 0);
    ASSERT_NE(second, 0);
    for (int i = 0; i < 45; ++i) see_at(0.12f);
    EXPECT_EQ(people.label_of(scene, 1), first);
    EXPECT_EQ(people.label_of(scene, 2), second);
    for (int i = 0; i <= 30; ++i) see_at(0.12f + 0.016f * float(i));
    EXPECT_EQ(people.label_of(scene, 1), first);
    EXPECT_EQ(people.label_of(scene, 2), second);
    EXPECT_GT(people.iou(scene, 1), 0.95);
    EXPECT_GT(people.iou(scene, 2), 0.95);
}

TEST(HardScene, AForearmBeforeSomebodyElseStaysWithItsOwner) {
    RoomScene scene;
    scene.people = {standing_person(-0.5f, -2.6f), standing_person(0.5f, -2.6f)};
    People people;
    people.see(scene);
    // An arm around the other's shoulders, a little before them.
    for (int i = 0; i < 20; ++i) {
        const float reach = 0.02f * float(i);
        scene.people = {standing_person(-0.28f, -2.6f), standing_person(0.28f, -2.6f)};
        scene.people[0].push_back({{-0.1f, 1.36f, -2.48f}, {-0.1f + reach, 1.30f, -2.38f}, 0.045f});
        people.see(scene);
    }
    EXPECT_GT(people.iou(scene, 1), 0.85);
    EXPECT_GT(people.iou(scene, 2), 0.85);
}

TEST(HardScene, OneHalfBehindTheOtherAreTwoInTheFirstImage) {
    RoomScene scene;
    scene.people = {standing_person(-0.13f, -2.5f), standing_person(0.13f, -2.8f)};
    scene.people[1].push_back(
        {{-0.05f, 1.15f, -2.5f}, {0.13f, 1.15f, -2.7f}, 0.05f});  // a hand on the other's back
    People people;
    EXPECT_EQ(people.see(scene).size(), 2u);
    EXPECT_GT(people.iou(scene, 1), 0.85);
    EXPECT_GT(people.iou(scene, 2), 0.75) << "the arm that joins them is seen whole, its owner is not";
}

TEST(HardScene, WhoPassesCloseBehindSomebodyKeepsTheNumber) {
    RoomScene scene;
    scene.people.resize(2);
    People people;
    uint8_t first = 0, second = 0;
    for (int i = 0; i <= 70; ++i) {
        const float x = -0.7f + 0.02f * float(i);
        scene.people[0] = standing_person(x, -2.4f);
        scene.people[1] = standing_person(-x, -2.75f);
        people.see(scene);
        if (i == 0) first = people.label_of(scene, 1), second = people.label_of(scene, 2);
    }
    ASSERT_NE(first, 0);
    ASSERT_NE(second, 0);
    EXPECT_EQ(people.label_of(scene, 1), first);
    EXPECT_EQ(people.label_of(scene, 2), second);
    EXPECT_GT(people.iou(scene, 1), 0.95);
    EXPECT_GT(people.iou(scene, 2), 0.95);
}

TEST(HardScene, TheWallBehindWhoWalksAwayIsNobody) {
    RoomScene scene;
    scene.wall_z = -3.2f;
    scene.side_x = 1.1f;
    scene.people.resize(1);
    People people;
    for (int i = 0; i < 120; ++i) {
        scene.people[0] = standing_person(0.7f - 0.025f * float(std::max(0, i - 50)), -2.6f);
        ASSERT_EQ(people.see(scene).size(), 1u) << i;
    }
}

TEST(HardScene, BeforeNothingThatTheSensorReaches) {
    RoomScene scene;
    scene.wall_z = -9.0f;
    scene.people.push_back(standing_person(0.0f, -2.6f));
    People people;
    for (int i = 0; i < 60; ++i) ASSERT_EQ(people.see(scene).size(), 1u) << i;
    EXPECT_GT(people.iou(scene), 0.95);
}

TEST(HardScene, WhoEntersIsNotTakenForWhoHasLeft) {
    RoomScene scene;
    scene.people.push_back(standing_person(-0.8f, -2.6f));
    People people;
    people.see(scene);
    const uint8_t first = people.label_of(scene, 1);
    ASSERT_NE(first, 0);
    for (int i = 0; i < 30; ++i) {  // out on the left
        scene.people[0] = standing_person(-0.8f - 0.04f * float(i), -2.6f);
        people.see(scene);
    }
    uint8_t second = 0;
    for (int i = 0; i < 30; ++i) {  // in on the right
        scene.people[0] = standing_person(1.9f - 0.04f * float(i), -2.6f);
        people.see(scene);
        if (i == 29) second = people.label_of(scene, 1);
    }
    EXPECT_NE(second, 0);
    EXPECT_NE(second, first);
    scene.people.push_back(standing_person(-1.0f, -2.6f));  // and the first is back
    people.see(scene);
    EXPECT_EQ(people.label_of(scene, 2), first);
    EXPECT_EQ(people.label_of(scene, 1), second);
}

TEST(HardScene, ADummyThatWasRejectedStaysAThingWhoeverPasses) {
    RoomScene scene;
    scene.dummies.push_back(standing_person(0.3f, -2.9f));  // a coat on a stand could not look more like it
    People people;
    const auto found = people.see(scene);
    ASSERT_EQ(found.size(), 1u);
    people.map.reject(found[0].id);
    for (int i = 0; i < 60; ++i) ASSERT_EQ(people.see(scene).size(), 0u) << i;
    scene.people.resize(1);
    for (int i = 0; i < 80; ++i) {  // close before it, from left to right
        scene.people[0] = standing_person(-1.0f + 0.025f * float(i), -2.4f);
        ASSERT_EQ(people.see(scene).size(), 1u) << i;
        ASSERT_GT(people.iou(scene), 0.9) << i;
    }
    for (int i = 0; i < 80; ++i) {  // and behind it
        scene.people[0] = standing_person(1.0f - 0.025f * float(i), -3.4f);
        ASSERT_LE(people.see(scene).size(), 1u) << i;
    }
    scene.people.clear();
    for (int i = 0; i < 60; ++i) ASSERT_EQ(people.see(scene).size(), 0u) << i;
}

TEST(HardScene, APlantInAPotComesNotBackOnceItWasRejected) {
    RoomScene scene;
    scene.dummies.push_back({{{0.0f, 0.1f, -2.5f}, {0.0f, 0.25f, -2.5f}, 0.16f}});  // pot
    for (int i = 0; i < 40; ++i) {                                                  // leaves
        const float turn = 2.4f * float(i), out = 0.08f + 0.18f * float(i % 7) / 6.0f,
                    up = 0.45f + 0.022f * float(i);
        const Vec3 leaf(out * std::cos(turn), up, -2.5f + out * std::sin(turn));
        scene.dummies[0].push_back({{0.0f, up - 0.1f, -2.5f}, leaf, 0.03f});
    }
    People people;
    for (int i = 0; i < 30; ++i) {
        const auto found = people.see(scene);
        if (!found.empty()) people.map.reject(found[0].id);
    }
    for (int i = 0; i < 120; ++i) ASSERT_EQ(people.see(scene).size(), 0u) << i;
}

TEST(HardScene, WhatStandsStillAndIsRejectedMayBeRejectedWithSomebodyBesideIt) {
    RoomScene scene;
    scene.dummies.push_back(standing_person(0.29f, -2.8f));
    scene.people.push_back(standing_person(-0.29f, -2.8f));  // touches it
    People people;
    ASSERT_EQ(people.see(scene).size(), 2u);
    const uint8_t own = people.label_of(scene, 1);
    for (uint32_t id = 1; id < 3; ++id)
        if (id != own) people.map.reject(id);
    for (int i = 0; i < 30; ++i) ASSERT_EQ(people.see(scene).size(), 1u) << i;
    EXPECT_EQ(people.label_of(scene, 1), own);
    EXPECT_GT(people.iou(scene), 0.85);
}

}  // namespace
}  // namespace vfit
