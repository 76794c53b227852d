// Garments worn over each other: which may be, and that they do not cross.
#include <gtest/gtest.h>

#include "cloth/crossings.h"
#include "outfit/outfit_check.h"
#include "people.h"
#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;

class LayersTest : public testing::Test {
protected:
    std::unique_ptr<Jobs> jobs = Jobs::own(1);
    const WearableGarment dress = wearable("sundress");
    Person she{VFIT_SEX_FEMALE};

    WearOptions on_skin() const {
        WearOptions options;
        options.on_skin = true;
        return options;
    }
    /// A size on the skin, with layers of its own.
    WearOptions in_size(const char* label) const {
        WearOptions options = on_skin();
        options.size = label;
        options.cloth.self_thickness_m = 0.004f;
        return options;
    }
};

size_t crossings_of(const WornGarment& inner, const WornGarment& outer) {
    return crossed_triangles({outer.positions(), outer.dress().indices()},
                             {inner.positions(), inner.dress().indices()})
        .size();
}

TEST_F(LayersTest, NoneIsWornOverItselfInACircleOrOnAnotherBody) {
    Person other(VFIT_SEX_FEMALE);
    WornGarment a(dress, she.wearer, on_skin(), *jobs), b(dress, she.wearer, on_skin(), *jobs),
        c(dress, she.wearer, on_skin(), *jobs), strange(dress, other.wearer, on_skin(), *jobs);
    EXPECT_TRUE(together(a, b).wear_over(a, b));
    EXPECT_TRUE(together(a, b, c).wear_over(b, c));
    EXPECT_FALSE(together(a, b, c).wear_over(a, b)) << "twice is once";
    EXPECT_EQ(a.below().size(), 1u);
    EXPECT_TRUE(a.reaches(c)) << "through b";
    EXPECT_EQ(error_of([&] { together(a, b, c).wear_over(b, a); }), "-2 inner is worn over cloth already");
    EXPECT_EQ(error_of([&] { together(a, b, c).wear_over(c, a); }), "-2 inner is worn over cloth already");
    EXPECT_EQ(error_of([&] { alone(strange).wear_over(strange, strange); }),
              "-2 a cloth cannot be worn over itself");
    EXPECT_EQ(error_of([&] { together(c, strange).wear_over(c, strange); }),
              "-2 both cloths must be of the same avatar");
    EXPECT_TRUE(c.below().empty());
    EXPECT_TRUE(together(a, b, c).wear_over(a, c)) << "over both is no circle";
    EXPECT_EQ(a.below().size(), 2u);
}

/// A body that moves aside by 3 cm a frame.
TEST_F(LayersTest, TheyDoNotCrossOnABodyThatMoves) {
    WornGarment inner(dress, she.wearer, on_skin(), *jobs), outer(dress, she.wearer, on_skin(), *jobs);
    const auto both = [&] { return together(inner, outer); };
    both().wear_over(outer, inner);
    for (int i = 0; i < 30; ++i) step(both());
    for (int frame = 1; frame <= 10; ++frame) {
        she.stand_at({0.03f * float(frame), 0.0f, 0.0f});
        step(both());
        EXPECT_EQ(crossings_of(inner, outer), 0u) << frame;
    }
}

TEST_F(LayersTest, PutOnItComesToLieOutsideOfItsLayer) {
    WornGarment inner(dress, she.wearer, on_skin(), *jobs), outer(dress, she.wearer, on_skin(), *jobs);
    together(inner, outer).wear_over(outer, inner);
    together(inner, outer).put_on();
    size_t outside = 0, count = 0;
    for (size_t v = 0; v < inner.positions().size(); ++v) {
        if (!inner.garment().simulated[v]) continue;
        const auto off_axis = [&](const WornGarment& of) {
            return std::hypot(of.positions()[v].x, of.positions()[v].z);
        };
        ++count;
        outside += off_axis(outer) > off_axis(inner);
    }
    EXPECT_GT(double(outside), 0.95 * double(count));
    EXPECT_EQ(crossings_of(inner, outer), 0u);
}

/// A wide hem below a coat: both stand there for a second, from several folds of the inner one.
TEST_F(LayersTest, ACoatOverAWideDressNeverCrossesIt) {
    const WearableGarment wide = wearable("sundress_pattern"), coat = wearable("duster");
    const WearOptions options = in_size("XL");
    for (const int frames : {0, 4, 6, 15}) {
        WornGarment inner(wide, she.wearer, options, *jobs), outer(coat, she.wearer, options, *jobs);
        for (int i = 0; i < frames; ++i) step(inner);
        together(inner, outer).wear_over(outer, inner);
        EXPECT_EQ(crossings_of(inner, outer), 0u) << frames;
        for (int i = 0; i < 60; ++i) {
            step(together(inner, outer));
            if (i % 10 == 9) {
                EXPECT_EQ(crossings_of(inner, outer), 0u) << frames << ", " << i;
            }
        }
        EXPECT_LT(outer.stats().strain_max, 0.6f);
    }
}

/// Held as close to the body as without a shirt, it would be pulled into that by its shoulders.
TEST_F(LayersTest, ATightVestIsHeldAsFarOffAsTheShirtNeeds) {
    Person he{VFIT_SEX_MALE};
    const WearableGarment shirts = wearable("shirt_men"), vests = wearable("vest");
    WornGarment shirt(shirts, he.wearer, {}, *jobs), vest(vests, he.wearer, {}, *jobs);
    for (int i = 0; i < 30; ++i) step(shirt);
    together(shirt, vest).wear_over(vest, shirt);
    for (const bool put_on : {false, true}) {
        if (put_on) together(shirt, vest).put_on();
        for (int i = 0; i < 60; ++i) step(together(shirt, vest));
        EXPECT_EQ(crossings_of(shirt, vest), 0u) << put_on;
        EXPECT_LT(vest.stats().strain_max, 0.5f) << put_on << ": 1.2 with limits for the body alone";
        EXPECT_LT(vest.stats().strain_p99, 0.2f) << put_on << ": 0.4 over a shirt that does not give way";
    }
}

TEST_F(LayersTest, OneThatIsMissingIsWornNoLonger) {
    WornGarment inner(dress, she.wearer, on_skin(), *jobs), outer(dress, she.wearer, on_skin(), *jobs);
    {
        WornGarment middle(dress, she.wearer, on_skin(), *jobs);
        together(inner, middle).wear_over(middle, inner);
        together(inner, middle, outer).wear_over(outer, middle);
        EXPECT_TRUE(outer.reaches(inner));
        step(together(outer, inner, middle));
        EXPECT_EQ(outer.piece().whole().fabric().pieces().size(), 3u);
    }
    const std::vector<Vec3> lay(outer.positions().begin(), outer.positions().end());
    step(together(outer, inner));
    EXPECT_EQ(outer.piece().whole().fabric().pieces().size(), 2u);
    EXPECT_TRUE(outer.below().empty());
    float most_m = 0.0f;
    for (size_t v = 0; v < lay.size(); ++v)
        most_m = std::max(most_m, glm::distance(outer.positions()[v], lay[v]));
    EXPECT_LT(most_m, 0.02f) << "it goes on from where it hung";
    step(alone(inner));
    EXPECT_FALSE(outer.shares_cloth_with(inner));
    step(alone(outer));
}

TEST_F(LayersTest, WhatIsLeftGoesOnAsFast) {
    WornGarment outer(dress, she.wearer, on_skin(), *jobs);
    {
        WornGarment inner(dress, she.wearer, on_skin(), *jobs);
        together(inner, outer).wear_over(outer, inner);
        for (int i = 1; i <= 20; ++i) {
            she.stand_at({0.01f * float(i), 0.0f, 0.0f});
            step(together(inner, outer));
        }
    }
    const std::vector<Vec3> all = outer.piece().whole().velocities();
    const std::vector<Vec3> before(all.end() - std::ptrdiff_t(outer.positions().size()), all.end());
    const WornTogether left = alone(outer);
    EXPECT_EQ(outer.piece().whole().velocities(), before);
    float sum = 0.0f;
    for (const Vec3& velocity : before) sum += velocity.x;
    EXPECT_GT(sum / float(before.size()), 0.2f) << "of a body at 0.6 m/s, damped while it settles";
}

TEST_F(LayersTest, OneWhereAnotherWasDestroyedIsNotTakenForIt) {
    WornGarment outer(dress, she.wearer, on_skin(), *jobs);
    std::optional<WornGarment> inner;
    for (int i = 0; i < 2; ++i) {
        inner.emplace(dress, she.wearer, on_skin(), *jobs);  // in the same place each time
        EXPECT_TRUE(together(*inner, outer).wear_over(outer, *inner)) << i;
        EXPECT_TRUE(outer.shares_cloth_with(*inner)) << i;
        EXPECT_EQ(crossings_of(*inner, outer), 0u) << i;
    }
}

TEST_F(LayersTest, WithoutAShirtAVestIsWornAsIfThereHadBeenNone) {
    Person he{VFIT_SEX_MALE};
    const WearableGarment shirts = wearable("shirt_men"), vests = wearable("vest");
    WornGarment vest(vests, he.wearer, on_skin(), *jobs), twin(vests, he.wearer, on_skin(), *jobs);
    {
        WornGarment shirt(shirts, he.wearer, on_skin(), *jobs);
        together(shirt, vest).wear_over(vest, shirt);
        step(together(shirt, vest));
    }
    for (WornGarment* worn : {&vest, &twin}) {
        alone(*worn).put_on();
        for (int i = 0; i < 10; ++i) step(*worn);
    }
    float most_m = 0.0f;
    for (size_t v = 0; v < vest.positions().size(); ++v)
        most_m = std::max(most_m, glm::distance(vest.positions()[v], twin.positions()[v]));
    EXPECT_LT(most_m, 0.001f);
}

TEST_F(LayersTest, WhatMetAPropMeetsItWithAnotherGarmentOverIt) {
    WornGarment inner(dress, she.wearer, on_skin(), *jobs), outer(dress, she.wearer, on_skin(), *jobs);
    Prop ball(sphere_mesh(0.1f));
    ball.move({0.0f, 1.0f, 0.6f}, Quat(1, 0, 0, 0));
    inner.meet(ball);
    step(inner);
    together(inner, outer).wear_over(outer, inner);
    outer.meet(ball);
    const WornGarment* const outfit[] = {&inner, &outer};
    for (int frame = 0; frame < 40; ++frame) {
        ball.move({0.0f, 0.75f, 0.6f - 0.008f * float(frame)}, Quat(1, 0, 0, 0));
        step(together(inner, outer));
    }
    for (const SurfaceCrossing& crossing : find_crossings(outfit, *jobs))
        EXPECT_NE(crossing.with, SurfaceCrossing::With::prop) << crossing.garment;
    EXPECT_FALSE(inner.props().positions(0).empty()) << "it is there";
}

TEST_F(LayersTest, GarmentsThatAreNotWornOverEachOtherPassThroughEachOther) {
    WornGarment inner(dress, she.wearer, on_skin(), *jobs), one(dress, she.wearer, on_skin(), *jobs),
        other(dress, she.wearer, on_skin(), *jobs);
    together(inner, one).wear_over(one, inner);
    together(inner, one, other).wear_over(other, inner);
    EXPECT_TRUE(one.shares_cloth_with(other));
    for (int i = 0; i < 10; ++i) step(together(inner, one, other));
    EXPECT_EQ(crossings_of(inner, one), 0u);
    EXPECT_EQ(crossings_of(inner, other), 0u);
    EXPECT_GT(crossings_of(one, other), 100u) << "twice in the same place";
    EXPECT_TRUE(together(inner, one, other).wear_over(other, one));
    for (int i = 0; i < 10; ++i) step(together(inner, one, other));
    EXPECT_EQ(crossings_of(one, other), 0u);
}

TEST_F(LayersTest, AnInnerGarmentChangesItsSize) {
    const WearableGarment wide = wearable("sundress_pattern"), coat = wearable("duster");
    const WearOptions options = in_size("M");
    WornGarment inner(wide, she.wearer, options, *jobs), outer(coat, she.wearer, options, *jobs);
    together(inner, outer).wear_over(outer, inner);
    for (int i = 0; i < 30; ++i) step(together(inner, outer));
    const uint64_t inner_hash = inner.state_hash(), outer_hash = outer.state_hash();
    EXPECT_NE(error_of([&] { inner.in_size("no such size"); }), "");
    EXPECT_EQ(inner.state_hash(), inner_hash);
    EXPECT_EQ(outer.state_hash(), outer_hash);
    together(inner, outer).change_to(inner, inner.in_size("L"));
    EXPECT_EQ(crossings_of(inner, outer), 0u);
    for (int i = 0; i < 60; ++i) step(together(inner, outer));
    EXPECT_EQ(crossings_of(inner, outer), 0u);
    EXPECT_LT(outer.stats().strain_max, 0.7f);
    EXPECT_LT(inner.stats().strain_max, 0.7f);
}

TEST_F(LayersTest, EachKeepsItsOwnFrictionAndTheyShareTheRest) {
    ClothSettings of[2];
    of[0].substeps = 12, of[0].thickness_m = 0.002f, of[0].sleeps = false, of[0].damping = 0.1f;
    of[1].substeps = 6, of[1].thickness_m = 0.005f, of[1].pressure = true, of[1].damping = 0.7f;
    const ClothSettings all = ClothSettings::joined(of);
    EXPECT_EQ(all.substeps, 12u);
    EXPECT_EQ(all.thickness_m, 0.005f);
    EXPECT_FALSE(all.sleeps);
    EXPECT_TRUE(all.pressure);
    EXPECT_EQ(all.damping, 0.7f) << "of the outer one";
}

TEST_F(LayersTest, WhatReachesFarBeyondIsRefused) {
    const WearableGarment wide = wearable("sundress_pattern"), jeans = wearable("jeans_women");
    WornGarment inner(wide, she.wearer, on_skin(), *jobs), outer(jeans, she.wearer, on_skin(), *jobs);
    const std::string error = error_of([&] { together(inner, outer).wear_over(outer, inner); });
    EXPECT_NE(error.find("jeans_women does not fit over sundress_pattern"), std::string::npos) << error;
    EXPECT_TRUE(outer.below().empty());
    EXPECT_FALSE(outer.shares_cloth_with(inner));
    for (WornGarment* worn : {&inner, &outer}) {
        step(*worn);
        EXPECT_LT(worn->stats().strain_max, 0.6f);
    }
}

}  // namespace
}  // namespace vfit
