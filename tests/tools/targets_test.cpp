// Figures beside their targets.
#include "bench/targets.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vfit::tools {
namespace {

TEST(Targets, AFigureOnTheTargetIsAHitAndOneBeyondIsAMiss) {
    Targets targets(true);
    EXPECT_TRUE(targets.judge("share", 0.96, Aim::at_least, 0.96));
    EXPECT_FALSE(targets.judge("share", 0.9599, Aim::at_least, 0.96));
    EXPECT_TRUE(targets.judge("time", 8.0, Aim::at_most, 8.0));
    EXPECT_FALSE(targets.judge("time", 8.01, Aim::at_most, 8.0));
    EXPECT_TRUE(targets.judge("bodies", 5, Aim::exactly, 5));
    EXPECT_FALSE(targets.judge("bodies", 6, Aim::exactly, 5));
    EXPECT_EQ(targets.count(), 6u);
    EXPECT_EQ(targets.missed(), 3u);
}

TEST(Targets, WhatCouldNotBeMeasuredIsAMiss) {
    Targets targets(true);
    EXPECT_FALSE(targets.judge("error", NAN, Aim::at_most, 3.5));
    EXPECT_FALSE(targets.judge("error", NAN, Aim::at_least, 3.5));
    EXPECT_TRUE(targets.json()[0]["figure"].is_null());
    EXPECT_FALSE(targets.json()[0]["hit"].get<bool>());
}

TEST(Targets, AMissIsPrintedAsOne) {
    Targets targets(false);
    testing::internal::CaptureStdout();
    targets.judge("joints", 0.912, Aim::at_least, 0.96, 3);
    targets.judge("time", 7.04, Aim::at_most, 8, 1, " ms");
    const std::string text = testing::internal::GetCapturedStdout();
    EXPECT_NE(text.find("0.912   >= 0.960     MISS\n"), std::string::npos) << text;
    EXPECT_NE(text.find("7.0 ms   <= 8.0 ms    hit\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace vfit::tools
