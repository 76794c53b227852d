// What the user map must not cost: memory, once it has seen its first images.
#include <gtest/gtest.h>

#include "room_scene.h"
#include "support/allocations.h"
#include "track/people_map.h"

namespace vfit {
namespace {

using testing::RoomScene;
using testing::standing_person;

TEST(PeopleMapCost, NoAllocationAfterTheFirstImages) {
    RoomScene scene;
    scene.people = {standing_person(-0.5f, -2.8f), standing_person(0.4f, -2.3f)};
    scene.render();
    PeopleMap map;
    std::vector<uint8_t> users(scene.depth.size());
    constexpr int64_t kFrame_ns = 33'333'333;
    for (int i = 1; i <= 3; ++i) map.run(scene.bare(), i * kFrame_ns, users.data());
    scene.people[1] = standing_person(-0.1f, -2.75f);  // touching: the splitter has to work
    scene.render(9);
    const DepthImage image = scene.bare();
    const uint64_t before = test::allocations.load();
    for (int i = 4; i <= 9; ++i) map.run(image, i * kFrame_ns, users.data());
    EXPECT_EQ(test::allocations.load(), before);
}

TEST(PeopleMapCost, NoAllocationWhereTheFloorComesIntoViewLater) {
    RoomScene scene;
    scene.floor = false;
    scene.render();
    PeopleMap map;
    std::vector<uint8_t> users(scene.depth.size());
    constexpr int64_t kFrame_ns = 33'333'333;
    for (int i = 1; i <= 3; ++i) map.run(scene.bare(), i * kFrame_ns, users.data());
    EXPECT_EQ(map.camera().floor_state, VFIT_FLOOR_DEFAULT);
    scene.floor = true;
    scene.people = {standing_person(0.0f, -2.5f)};
    scene.render(2);
    const DepthImage image = scene.bare();
    const uint64_t before = test::allocations.load();
    for (int i = 4; i <= 20; ++i) map.run(image, i * kFrame_ns, users.data());
    EXPECT_EQ(test::allocations.load(), before);
    EXPECT_EQ(map.camera().floor_state, VFIT_FLOOR_ESTIMATED);
}

}  // namespace
}  // namespace vfit
