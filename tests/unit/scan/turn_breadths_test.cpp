// The trunk's girths from its outline, seen from all around.
#include "scan/turn_breadths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "avatar/avatar_measures.h"
#include "scan/seen_measures.h"
#include "scan/turn_ring.h"
#include "scan_people.h"

namespace vfit {
namespace {

/// Girths of a person who turns once round in steps of 15 degrees, or only begins to.
SectionGirths turned(Avatar& avatar, float arms_rad, bool whole = true) {
    BodyScan scan(fit_model());
    int64_t time_ns = 0;
    const auto add = [&](float turned_rad, const auto& take) {
        Stance stance;
        stance.turned_rad = turned_rad, stance.arms_rad = arms_rad;
        const FitScene scene = standing_person(avatar, stance);
        Body body = scene.joints;
        body.time_ns = time_ns += 33333333;
        take(scene.image(), body);
    };
    for (int i = 0; i < 4; ++i)
        add(0.0f, [&](const auto& image, const Body& body) { scan.add(image, body); });
    for (int way = 0; way < (whole ? 24 : 4); ++way)
        add(float(way) * kPi / 12.0f, [&](const auto& image, const Body& body) {
            if (scan.fit_turning(image, body)) scan.keep_turning(image, body);
        });
    return scan.turned_girths_m();
}

TEST(TurnBreadths, TheGirthIsThatOfATapeWhateverTheBody) {
    for (const auto& components : {std::vector<float>{}, {2.0f}, {-1.0f, 1.5f}}) {
        Avatar avatar(body_model(), {}, shape_of(components), Vec2(1.0f));
        const auto tape = measure_avatar(avatar, VFIT_SEX_FEMALE);
        const SeenMeasures seen = seen_measures(1.7f, turned(avatar, 0.75f), true);
        EXPECT_NEAR(seen.waist_girth_m, find(tape, "waist_girth_m")->value, 0.025f);
        EXPECT_NEAR(seen.hip_girth_m, find(tape, "hip_girth_m")->value, 0.025f);
    }
}

TEST(TurnBreadths, ArmsAreNoPartOfTheTrunk) {
    Avatar avatar(body_model(), {}, shape_of({}), Vec2(1.0f));
    const SectionGirths wide = turned(avatar, 1.2f), low = turned(avatar, 0.6f);
    for (const size_t level : {6, 9, 12, 15, 17}) EXPECT_NEAR(low[level], wide[level], 0.02f) << level;
}

TEST(TurnBreadths, APartOfATurnIsNotTakenForAll) {
    Avatar avatar(body_model(), {}, shape_of({}), Vec2(1.0f));
    EXPECT_TRUE(std::isnan(turned(avatar, 0.75f, false)[12]));
}

TEST(TurnRing, CountsWaysToThePersonsLeft) {
    EXPECT_EQ(TurnRing::way_of(0.1f), 0);
    EXPECT_EQ(TurnRing::way_of(-0.1f), 0);
    EXPECT_EQ(TurnRing::way_of(0.5f * kPi), 6);
    EXPECT_EQ(TurnRing::way_of(-0.5f * kPi), 18);
    EXPECT_EQ(TurnRing::way_of(kPi), 12);
    EXPECT_EQ(TurnRing::way_of(-kPi), 12);
    TurnRing ring;
    for (int way = 0; way < TurnRing::kWays; ++way) {
        EXPECT_NE(ring.seen(), TurnRing::kAll);
        ring.add(way);
    }
    EXPECT_EQ(ring.seen(), TurnRing::kAll);
    EXPECT_TRUE(ring.complete());
    ring.reset();
    EXPECT_EQ(ring.seen(), 0u);
    EXPECT_FALSE(ring.complete());
}

TEST(TurnRing, IsCompleteWhereTheOppositeOfWhatIsMissingWasSeen) {
    const auto without = [](std::initializer_list<int> missing) {
        TurnRing ring;
        for (int way = 0; way < TurnRing::kWays; ++way)
            if (std::find(missing.begin(), missing.end(), way) == missing.end()) ring.add(way);
        return ring.complete();
    };
    EXPECT_TRUE(without({3, 4}));
    EXPECT_TRUE(without({0, 1, 2, 3}));
    EXPECT_FALSE(without({0, 1, 2, 3, 4})) << "too many";
    EXPECT_FALSE(without({5, 17})) << "opposite each other";
}

}  // namespace
}  // namespace vfit
