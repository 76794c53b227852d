// People who stand sway by millimetres; things do not.
#include <gtest/gtest.h>

#include <cmath>

#include "people_player.h"

namespace vfit {
namespace {

using testing::kFrame_ns;
using testing::People;
using testing::RoomScene;
using testing::standing_person;

/// Quiet standing: 4 mm to and fro, 3 mm aside.
void sway(RoomScene& scene, float t_s) {
    scene.people[0] = standing_person(0.003f * std::sin(2.0f * kPi * 0.23f * t_s),
                                      -2.6f + 0.004f * std::sin(2.0f * kPi * 0.31f * t_s));
}

float lifeless_s(std::span<const PersonRegion> people) {
    return people.empty() ? -1.0f : people[0].lifeless_s;
}

TEST(LifeSigns, WhatStandsStillIsLifelessWithinASecond) {
    RoomScene scene;
    scene.dummies.push_back(standing_person(0.2f, -2.6f));
    People people;
    for (int i = 0; i < 30; ++i) ASSERT_EQ(people.see(scene).size(), 1u) << i;
    for (int i = 0; i < 60; ++i) ASSERT_GT(lifeless_s(people.see(scene)), 0.0f) << i;
}

TEST(LifeSigns, WhatIsPutDownIsLifelessASecondLater) {
    RoomScene scene;
    scene.dummies.resize(1);
    People people;
    for (int i = 0; i < 60; ++i) {
        scene.dummies[0] = standing_person(-1.0f + 0.02f * float(i), -2.6f);
        EXPECT_LE(lifeless_s(people.see(scene)), 0.0f) << i;
    }
    for (int i = 0; i < 30; ++i) people.see(scene);
    EXPECT_GT(lifeless_s(people.see(scene)), 0.0f);
}

TEST(LifeSigns, WhoSwaysAsPeopleDoIsAliveAllTheTime) {
    RoomScene scene;
    scene.people.resize(1);
    People people;
    for (int i = 0; i < 150; ++i) {
        sway(scene, float(i) / 30.0f);
        ASSERT_EQ(lifeless_s(people.see(scene)), 0.0f) << i;
    }
}

TEST(LifeSigns, WhoHasLivedMayHoldTheirBreath) {
    RoomScene scene;
    scene.people.resize(1);
    People people;
    for (int i = 0; i < 150; ++i) {
        sway(scene, float(i) / 30.0f);
        people.see(scene);
    }
    for (int i = 0; i < 75; ++i) ASSERT_EQ(lifeless_s(people.see(scene)), 0.0f) << i;
}

TEST(LifeSigns, APictureThatIsRepeatedSaysNothing) {
    RoomScene scene;
    scene.people.push_back(standing_person(0.2f, -2.6f));
    People people;
    scene.render();
    people.users.resize(scene.depth.size());
    for (int i = 1; i < 90; ++i)
        ASSERT_EQ(lifeless_s(people.map.run(scene.bare(), i * kFrame_ns, people.users.data())), 0.0f) << i;
}

}  // namespace
}  // namespace vfit
