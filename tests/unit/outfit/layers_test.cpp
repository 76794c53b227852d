// Garments worn over each other: which may be, and that the outer one meets each layer where its last step
// left it.
#include <gtest/gtest.h>

#include "cloth/crossings.h"
#include "measure/mesh_query.h"
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
};

TEST_F(LayersTest, NoneIsWornOverItselfInACircleOrOnAnotherBody) {
    Person other(VFIT_SEX_FEMALE);
    WornGarment a(dress, she.wearer, {}, *jobs), b(dress, she.wearer, {}, *jobs),
        c(dress, she.wearer, {}, *jobs), strange(dress, other.wearer, {}, *jobs);
    EXPECT_TRUE(a.wear_over(b));
    EXPECT_TRUE(b.wear_over(c));
    EXPECT_FALSE(a.wear_over(b)) << "twice is once";
    EXPECT_EQ(a.layers().count(), 1u);
    EXPECT_TRUE(a.layers().reach(c));
    EXPECT_FALSE(a.layers().has(c));
    EXPECT_EQ(error_of([&] { b.wear_over(a); }), "-2 inner is worn over cloth already");
    EXPECT_EQ(error_of([&] { c.wear_over(a); }), "-2 inner is worn over cloth already") << "through b";
    EXPECT_EQ(error_of([&] { c.wear_over(c); }), "-2 a cloth cannot be worn over itself");
    EXPECT_EQ(error_of([&] { c.wear_over(strange); }), "-2 both cloths must be of the same avatar");
    EXPECT_EQ(c.layers().count(), 0u);
    EXPECT_TRUE(a.wear_over(c)) << "over both is no circle";
    EXPECT_EQ(a.layers().count(), 2u);
}

TEST_F(LayersTest, ALayerIsSeenBeforeAStep) {
    WornGarment inner(dress, she.wearer, {}, *jobs), outer(dress, she.wearer, {}, *jobs);
    outer.wear_over(inner);
    EXPECT_EQ(error_of([&] { step(outer); }).substr(0, 3), "-2 ");
    outer.see_layer(0, inner.positions());
    EXPECT_EQ(error_of([&] { step(outer); }), "");
}

/// The most crossings between both, of a body that moves aside by 3 cm a frame.
size_t crossings(WornGarment& inner, WornGarment& outer, Person& wearer, bool inner_first) {
    size_t max_count = 0;
    for (int frame = 1; frame <= 10; ++frame) {
        wearer.stand_at({0.03f * float(frame), 0.0f, 0.0f});
        if (inner_first) step(inner);
        outer.see_layer(0, inner.positions());
        step(outer);
        if (!inner_first) step(inner);
        max_count = std::max(max_count, crossed_triangles({outer.positions(), outer.dress().indices()},
                                                          {inner.positions(), inner.dress().indices()})
                                            .size());
    }
    return max_count;
}

TEST_F(LayersTest, SteppedInnerFirstTheyHardlyCross) {
    size_t found[2];
    for (const bool inner_first : {false, true}) {
        she.stand_at({});
        WornGarment inner(dress, she.wearer, on_skin(), *jobs), outer(dress, she.wearer, on_skin(), *jobs);
        outer.wear_over(inner);
        outer.see_layer(0, inner.positions());
        outer.put_on();
        for (int i = 0; i < 30; ++i) {
            step(inner);
            outer.see_layer(0, inner.positions());
            step(outer);
        }
        found[inner_first] = crossings(inner, outer, she, inner_first);
    }
    EXPECT_LT(50 * found[true], found[false]);
}

TEST_F(LayersTest, PutOnItComesToLieOutsideOfItsLayer) {
    WornGarment inner(dress, she.wearer, on_skin(), *jobs), outer(dress, she.wearer, on_skin(), *jobs);
    outer.wear_over(inner);
    outer.see_layer(0, inner.positions());
    outer.put_on();
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
}

size_t crossings_of(const WornGarment& inner, const WornGarment& outer) {
    return crossed_triangles({outer.positions(), outer.dress().indices()},
                             {inner.positions(), inner.dress().indices()})
        .size();
}

/// A wide hem below a coat: both stand there for a second, from several folds of the inner one.
TEST_F(LayersTest, ACoatOverAWideDressNeverCrossesIt) {
    const WearableGarment wide = wearable("sundress_pattern"), coat = wearable("duster");
    WearOptions options = on_skin();
    options.size = "XL";
    options.cloth.self_thickness_m = 0.004f;
    for (const int frames : {0, 15}) {
        WornGarment inner(wide, she.wearer, options, *jobs), outer(coat, she.wearer, options, *jobs);
        for (int i = 0; i < frames; ++i) step(inner);
        outer.wear_over(inner);
        outer.see_layer(0, inner.positions());
        outer.come_outside_of_last_layer();
        EXPECT_EQ(crossings_of(inner, outer), 0u) << frames;
        for (int i = 0; i < 60; ++i) {
            step(inner);
            outer.see_layer(0, inner.positions());
            step(outer);
            if (i % 10 == 9) {
                EXPECT_EQ(crossings_of(inner, outer), 0u) << frames << ", " << i;
            }
        }
        EXPECT_LT(outer.stats().strain_max, 0.6f);
    }
}

/// Held as close to the body as without a shirt, it was pulled into that in each step.
TEST_F(LayersTest, ATightVestKeepsItsDistanceFromTheShirt) {
    Person he{VFIT_SEX_MALE};
    WornGarment shirt(wearable("shirt_men"), he.wearer, {}, *jobs),
        vest(wearable("vest"), he.wearer, {}, *jobs);
    for (int i = 0; i < 30; ++i) step(shirt);
    vest.wear_over(shirt);
    vest.see_layer(0, shirt.positions());
    vest.put_on();
    for (int i = 0; i < 60; ++i) {
        step(shirt);
        vest.see_layer(0, shirt.positions());
        step(vest);
    }
    const MeshQuery below(shirt.positions(), shirt.dress().indices());
    size_t pulled_in = 0;
    for (const Vec3& place : vest.positions()) pulled_in += below.closest(place).distance < 0.002f;
    EXPECT_LT(pulled_in, 4u) << "12 with limits for the body alone";
}

TEST_F(LayersTest, WhatReachesFarBeyondIsRefused) {
    const WearableGarment wide = wearable("sundress_pattern"), jeans = wearable("jeans_women");
    WornGarment inner(wide, she.wearer, on_skin(), *jobs), outer(jeans, she.wearer, on_skin(), *jobs);
    outer.wear_over(inner);
    outer.see_layer(0, inner.positions());
    const std::string error = error_of([&] { outer.come_outside_of_last_layer(); });
    EXPECT_NE(error.find("jeans_women does not fit over sundress_pattern"), std::string::npos) << error;
    EXPECT_EQ(outer.layers().count(), 0u);
    step(outer);
    EXPECT_LT(outer.stats().strain_max, 0.6f);
    EXPECT_TRUE(outer.wear_over(inner)) << "again";
}

}  // namespace
}  // namespace vfit
