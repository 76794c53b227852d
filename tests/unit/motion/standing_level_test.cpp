// The height of standing ankles: found under noise, then still; found again on another floor.
#include "motion/standing_level.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace vfit {
namespace {

constexpr float kFrameS = 1.0f / 30.0f, kFloor = 0.08f;

TEST(StandingLevel, IsFoundInASecondOfNoiseAndThenMovesLessThanIsSeen) {
    std::mt19937 engine(3);
    std::normal_distribution<float> noise(0.0f, 0.01f);
    StandingLevel level;
    float before = 0.0f, fastest = 0.0f, worst = 0.0f;
    for (int i = 0; i < 900; ++i) {
        const float outlier = i % 50 == 7 ? -0.08f : 0.0f;
        level.update(kFloor + noise(engine) + outlier, kFrameS);
        const float now = level.value(0.0f);
        if (i > 30) {
            fastest = std::max(fastest, std::abs(now - before));
            worst = std::max(worst, std::abs(now - kFloor));
        }
        before = now;
    }
    EXPECT_LT(fastest, 0.00021f);
    EXPECT_LT(worst, 0.006f);
    EXPECT_NEAR(before, kFloor, 0.002f);
}

TEST(StandingLevel, ForgetsWhatATrackerReportsBeforeItHasSettled) {
    StandingLevel level;
    for (int i = 0; i < 30; ++i)
        level.update(kFloor - 0.1f * std::exp(-0.3f * static_cast<float>(i)), kFrameS);
    EXPECT_NEAR(level.value(0.0f), kFloor, 0.003f);
}

TEST(StandingLevel, IsFoundAgainOfThoseWhoStepOnAnotherFloor) {
    StandingLevel level;
    for (int i = 0; i < 60; ++i) level.update(kFloor, kFrameS);
    for (int i = 0; i < 10; ++i) level.update(kFloor + 0.2f, kFrameS);
    EXPECT_NEAR(level.value(0.0f), kFloor, 0.003f) << "not for a moment's error";
    for (int i = 0; i < 10; ++i) level.update(kFloor + 0.2f, kFrameS);
    EXPECT_NEAR(level.value(0.0f), kFloor + 0.2f, 0.001f);
}

TEST(StandingLevel, IsTheGivenOneBeforeAnyFootStood) { EXPECT_EQ(StandingLevel().value(0.07f), 0.07f); }

}  // namespace
}  // namespace vfit
