// Crossings of the surfaces of an outfit: which are found, of which step, and that none are missed.
#include "outfit/outfit_check.h"

#include <gtest/gtest.h>

#include "people.h"
#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;
using With = SurfaceCrossing::With;

class OutfitCheckTest : public testing::Test {
protected:
    std::unique_ptr<Jobs> jobs = Jobs::own(1);
    const WearableGarment dress = wearable("sundress");
    Person she{VFIT_SEX_FEMALE};

    size_t count(std::span<const WornGarment* const> outfit, With with, uint32_t garment = 0) {
        for (const SurfaceCrossing& c : find_crossings(outfit, *jobs))
            if (c.with == with && c.garment == garment) return c.pair_count;
        return 0;
    }
    /// Pressed against the body, which is coarse spheres and capsules to it.
    void press(WornGarment& worn) {
        for (int i = 0; i < 60; ++i) step(worn);
    }
    WearOptions pressed() const {
        WearOptions options;
        options.cloth.gravity = {0.0f, -6.0f, 6.0f};
        return options;
    }
    static MeshView mesh(const WornGarment& worn) {
        return {worn.finished().positions(), worn.dress().indices()};
    }
};

TEST_F(OutfitCheckTest, EachPairOfSurfacesIsCountedWithItsFirstPair) {
    WornGarment a(dress, she.wearer, pressed(), *jobs), b(dress, she.wearer, {}, *jobs);
    press(a);
    const WornGarment* const outfit[] = {&a, &b};
    const auto found = find_crossings(outfit, *jobs);
    const std::vector<Vec3> skin = she.wearer.posed(a.finished().pose(), *jobs);
    const auto expected = [&](const SurfaceCrossing& c) {
        const WornGarment& of = *outfit[c.garment];
        if (c.with == With::itself) return crossed_triangles(mesh(of).positions, mesh(of).indices);
        return crossed_triangles(
            mesh(of), c.with == With::skin ? MeshView{skin, she.wearer.indices()} : mesh(*outfit[c.other]));
    };
    for (const SurfaceCrossing& c : found) {
        const auto all = expected(c);
        EXPECT_EQ(c.pair_count, all.size());
        EXPECT_NE(std::find(all.begin(), all.end(), c.first), all.end());
    }
    EXPECT_GT(count(outfit, With::garment), 100u) << "one hangs, one is pressed";
    EXPECT_GT(count(outfit, With::skin), 10u);
    EXPECT_EQ(count(outfit, With::skin, 1), 0u) << "not stepped: where the bones carry it";
}

TEST_F(OutfitCheckTest, AnOutfitWithoutCrossingsIsEmptyOfThem) {
    WearOptions options;
    options.on_skin = true;
    options.cloth.self_thickness_m = 0.004f;
    WornGarment inner(dress, she.wearer, options, *jobs), outer(dress, she.wearer, options, *jobs);
    const WornGarment* const outfit[] = {&inner, &outer};
    const size_t before = count(outfit, With::garment);
    together(inner, outer).wear_over(outer, inner);
    together(inner, outer).put_on();
    for (int i = 0; i < 60; ++i) step(together(inner, outer));
    EXPECT_GT(before, 1000u) << "twice in the same place";
    EXPECT_TRUE(find_crossings(outfit, *jobs).empty());
}

TEST_F(OutfitCheckTest, TheSkinIsThatOfTheStepAndNotOfThePoseSince) {
    WornGarment worn(dress, she.wearer, pressed(), *jobs);
    press(worn);
    const WornGarment* const outfit[] = {&worn};
    const auto before = find_crossings(outfit, *jobs);
    ASSERT_FALSE(before.empty());
    she.stand_at({5.0f, 0.0f, 0.0f});
    const auto after = find_crossings(outfit, *jobs);
    ASSERT_EQ(after.size(), before.size());
    for (size_t i = 0; i < after.size(); ++i) {
        EXPECT_EQ(after[i].pair_count, before[i].pair_count);
        EXPECT_EQ(after[i].first, before[i].first);
    }
}

}  // namespace
}  // namespace vfit
