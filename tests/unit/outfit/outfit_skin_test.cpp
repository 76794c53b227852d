// The skin that is drawn below an outfit: in which pose, and that it does not cross the garments.
#include "outfit/outfit_skin.h"

#include <gtest/gtest.h>

#include "cloth/crossings.h"
#include "people.h"
#include "support/allocation_count.h"  // counted by body_jump_test.cpp

namespace vfit {
namespace {

using namespace test;

class OutfitSkinTest : public testing::Test {
protected:
    std::unique_ptr<Jobs> jobs = Jobs::own(1);
    const WearableGarment dress = wearable("sundress");
    Person she{VFIT_SEX_FEMALE};
    OutfitSkin skin{she.avatar};

    /// Pressed against the body, which is spheres and capsules to it.
    static WearOptions pressed() {
        WearOptions options;
        options.cover_m = 0.01f;
        options.cloth.gravity = {0.0f, -6.0f, 6.0f};
        return options;
    }
    size_t crossings(const WornGarment& worn, const std::vector<Vec3>& skin_positions) const {
        const MeshView cloth{worn.finished().shown().positions, worn.dress().indices()},
            body{std::span(skin_positions).first(she.avatar.topology().vertex_count),
                 she.avatar.topology().indices};
        return crossed_triangles(cloth, body).size();
    }
    const std::vector<Vec3>& posed() {
        she.avatar.pose(she.avatar.shown_pose(), *jobs);
        return she.avatar.positions();
    }
};

TEST_F(OutfitSkinTest, WhereTheSkinWouldComeThroughItGivesWayBelowAllGarments) {
    WornGarment a(dress, she.wearer, pressed(), *jobs), b(dress, she.wearer, pressed(), *jobs);
    for (int i = 0; i < 60; ++i) step(a);
    for (int i = 0; i < 20; ++i) step(b);
    const std::vector<Vec3> own = posed();
    ASSERT_GT(crossings(a, own), 10u);
    ASSERT_GT(crossings(b, own), 10u);
    WornGarment* const outfit[] = {&a, &b};
    const OutfitSkin::Drawn drawn = skin.below(outfit, *jobs);
    EXPECT_EQ(drawn.crossing_pairs, 0u);
    EXPECT_EQ(crossings(a, drawn.positions), 0u);
    EXPECT_EQ(crossings(b, drawn.positions), 0u);
    size_t moved = 0;
    for (size_t v = 0; v < own.size(); ++v) {
        const float way_m = glm::distance(own[v], drawn.positions[v]);
        EXPECT_LE(way_m, 0.0201f);
        moved += way_m > 0.0f;
    }
    EXPECT_GT(moved, 10u);
    EXPECT_LT(moved, own.size() / 10);
    const auto& sources = she.avatar.topology().seam_sources;
    for (size_t i = 0; i < sources.size(); ++i)
        EXPECT_EQ(drawn.positions[she.avatar.topology().vertex_count + i], drawn.positions[sources[i]]);
}

TEST_F(OutfitSkinTest, ThePoseIsThatInWhichTheFirstGarmentIsShown) {
    WornGarment worn(dress, she.wearer, {}, *jobs);
    WornGarment* const outfit[] = {&worn};
    const std::vector<Vec3> before = posed();
    she.stand_at({1.0f, 0.0f, 0.0f});
    const auto way_of_head = [&] {
        return glm::distance(skin.below(outfit, *jobs).positions.front(), before.front());
    };
    EXPECT_NEAR(way_of_head(), 0.0f, 1e-5f) << "the garment has not been stepped there yet";
    worn.reskin();
    EXPECT_NEAR(way_of_head(), 1.0f, 1e-5f);
    she.stand_at({3.0f, 0.0f, 0.0f});
    step(worn);
    EXPECT_NEAR(way_of_head(), 3.0f, 1e-5f);
}

TEST_F(OutfitSkinTest, AgainInOnePoseDoesNotAllocate) {
    WornGarment worn(dress, she.wearer, pressed(), *jobs);
    for (int i = 0; i < 30; ++i) step(worn);
    WornGarment* const outfit[] = {&worn};
    skin.below(outfit, *jobs);
    const uint64_t before = allocations;
    skin.below(outfit, *jobs);
    EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace vfit
