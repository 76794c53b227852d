// Girths of a turn beside what other views make likely.
#include "scan/turned_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace vfit {
namespace {

constexpr float kUnseen = std::numeric_limits<float>::quiet_NaN();
constexpr TurnedGirth kUsual{0.01f, 0.02f};

TEST(TurnedMeasures, AreCombinedByTheirErrors) {
    std::vector<Measurement> list = {{"waist_girth_m", 0.80f, 0.02f, false},
                                     {"stature_m", 1.7f, 0.01f, true}};
    combine_with_turn(list, {kUnseen, kUnseen, 0.83f, kUnseen}, {kUsual, kUsual, kUsual});
    EXPECT_NEAR(list[0].value, 0.82f, 1e-5f) << "half way to 0.83 and its offset";
    EXPECT_NEAR(list[0].sigma, 0.02f * std::sqrt(0.75f), 1e-5f) << "half of the errors is in common";
    EXPECT_TRUE(list[0].observed);
    EXPECT_EQ(list[1].value, 1.7f);
}

TEST(TurnedMeasures, AnUnsureEstimateGivesWay) {
    std::vector<Measurement> list = {{"hip_girth_m", 1.0f, 0.2f, true}};
    combine_with_turn(list, {kUnseen, kUnseen, kUnseen, 1.2f}, {kUsual, kUsual, {0.0f, 0.02f}});
    EXPECT_NEAR(list[0].value, 1.2f, 1e-5f);
    EXPECT_NEAR(list[0].sigma, 0.02f, 1e-5f);
}

TEST(TurnedMeasures, AnUnsureTurnDoesNotWidenASureEstimate) {
    std::vector<Measurement> list = {{"chest_girth_m", 0.9f, 0.015f, true}};
    combine_with_turn(list, {kUnseen, 1.0f, kUnseen, kUnseen}, {{0.0f, 0.04f}, kUsual, kUsual});
    EXPECT_EQ(list[0].value, 0.9f);
    EXPECT_EQ(list[0].sigma, 0.015f);
}

TEST(TurnedMeasures, WhatIsNotSeenChangesNothing) {
    std::vector<Measurement> list = {{"chest_girth_m", 0.9f, 0.02f, true}};
    combine_with_turn(list, {kUnseen, kUnseen, 0.8f, 1.0f}, {kUsual, kUsual, kUsual});
    EXPECT_EQ(list.size(), 1u) << "no measure is added";
    EXPECT_EQ(list[0].value, 0.9f);
    EXPECT_EQ(list[0].sigma, 0.02f);
}

}  // namespace
}  // namespace vfit
