// Girths of a turn beside what other views make likely.
#include "scan/turned_measures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vfit {
namespace {

constexpr TurnedGirth kUsual{0.01f, 0.02f};
constexpr TurnedGirths kAllUsual{kUsual, kUsual, kUsual, kUsual, kUsual};

SeenMeasures seen(float SeenMeasures::* measure, float value) {
    SeenMeasures out;
    out.*measure = value;
    return out;
}

TEST(TurnedMeasures, AreCombinedByTheirErrors) {
    std::vector<Measurement> list = {{"waist_girth_m", 0.80f, 0.02f, false},
                                     {"stature_m", 1.7f, 0.01f, true}};
    combine_with_turn(list, seen(&SeenMeasures::waist_girth_m, 0.83f), kAllUsual, 1.0f);
    EXPECT_NEAR(list[0].value, 0.82f, 1e-5f) << "half way to 0.83 and its offset";
    EXPECT_NEAR(list[0].sigma, 0.02f * std::sqrt(0.75f), 1e-5f) << "half of the errors is in common";
    EXPECT_TRUE(list[0].observed);
    EXPECT_EQ(list[1].value, 1.7f);
}

TEST(TurnedMeasures, AnUnsureEstimateGivesWay) {
    std::vector<Measurement> list = {{"hip_girth_m", 1.0f, 0.2f, true}};
    TurnedGirths errors = kAllUsual;
    errors[2].offset_m = 0.0f;
    combine_with_turn(list, seen(&SeenMeasures::hip_girth_m, 1.2f), errors, 1.0f);
    EXPECT_NEAR(list[0].value, 1.2f, 1e-5f);
    EXPECT_NEAR(list[0].sigma, 0.02f, 1e-5f);
}

TEST(TurnedMeasures, AnUnsureTurnDoesNotWidenASureEstimate) {
    std::vector<Measurement> list = {{"chest_girth_m", 0.9f, 0.015f, true}};
    TurnedGirths errors = kAllUsual;
    errors[0] = {0.0f, 0.08f};
    combine_with_turn(list, seen(&SeenMeasures::chest_girth_m, 1.0f), errors, 1.0f);
    EXPECT_EQ(list[0].value, 0.9f);
    EXPECT_EQ(list[0].sigma, 0.015f);
}

TEST(TurnedMeasures, OfStrangePeopleATurnIsLessSure) {
    std::vector<Measurement> list = {{"hip_girth_m", 1.0f, 10.0f, true}};
    combine_with_turn(list, seen(&SeenMeasures::hip_girth_m, 1.2f), kAllUsual, 3.0f);
    EXPECT_NEAR(list[0].sigma, 0.06f, 1e-3f);
}

TEST(TurnedMeasures, WhatIsNotSeenChangesNothing) {
    std::vector<Measurement> list = {{"chest_girth_m", 0.9f, 0.02f, true}};
    combine_with_turn(list, seen(&SeenMeasures::waist_navel_girth_m, 0.8f), kAllUsual, 1.0f);
    EXPECT_EQ(list.size(), 1u) << "no measure is added";
    EXPECT_EQ(list[0].value, 0.9f);
    EXPECT_EQ(list[0].sigma, 0.02f);
}

}  // namespace
}  // namespace vfit
