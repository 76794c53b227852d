// Girths that are read off outlines and depth alone.
#include "scan/seen_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "math/types.h"

namespace vfit {
namespace {

/// Perimeter of an ellipse (Ramanujan 1914).
float ellipse(float a, float b) {
    const float h = (a - b) * (a - b) / ((a + b) * (a + b));
    return kPi * (a + b) * (1.0f + 3.0f * h / (10.0f + std::sqrt(4.0f - 3.0f * h)));
}

/// Half axes of a section in centimetres: across, ahead of the spine and behind it.
struct Half {
    float across, ahead, behind;
};

/// A trunk of elliptic sections as a scan sees it.
ScanFeatures trunk(const std::function<Half(float)>& along) {
    ScanFeatures f;
    f.fill(std::nanf(""));
    f[kCrownFeature] = 1.75f;
    for (int l = 0; l < TrunkProfile::kLevels; ++l) {
        const Half h = along(TrunkProfile::along(l));
        float* front = &f[kFrontReaches + size_t(l) * TrunkProfile::kReachesFromFront];
        float* side = &f[kSideReaches + size_t(l) * TrunkProfile::kReaches];
        front[TrunkProfile::kTowards] = h.ahead - 3.0f;  // the fitted spine lies 3 cm off in depth
        side[TrunkProfile::kTowards] = h.across + 2.0f;
        front[TrunkProfile::kAhead] = h.across;
        side[TrunkProfile::kAhead] = h.ahead, side[TrunkProfile::kBehind] = h.behind;
        for (int q = 1; q <= 3; ++q) {
            const float round = std::sqrt(1.0f - float(q * q) / 16.0f);
            front[TrunkProfile::kAhead + q] = round * h.ahead - 3.0f;
            side[TrunkProfile::kAhead + q] = round * h.across + 2.0f;
            side[TrunkProfile::kBehind + q] = round * h.across + 2.0f;
        }
    }
    return f;
}

SeenMeasures seen_of(const ScanFeatures& f, bool female) {
    return seen_measures(f[kCrownFeature], section_girths(f), female);
}

TEST(SeenMeasures, AreTheGirthsOfWhatIsSeen) {
    const ScanFeatures f = trunk([](float) { return Half{17.0f, 11.0f, 11.0f}; });
    const SeenMeasures seen = seen_of(f, true);
    EXPECT_EQ(seen.stature_m, 1.75f);
    EXPECT_NEAR(seen.waist_girth_m, 0.01f * ellipse(17.0f, 11.0f), 0.015f);
    EXPECT_NEAR(seen.hip_girth_m, seen.waist_girth_m, 1e-4f);
    EXPECT_EQ(seen_of(f, false).waist_girth_m, seen.waist_girth_m);
    EXPECT_TRUE(std::isnan(seen.chest_girth_m)) << "from the side the arms hide it";
}

TEST(SeenMeasures, AreTakenAtTheirLevels) {
    // Wider downwards: the hip is the largest section, a woman's waist lies above a man's.
    const auto narrower_upwards = [](float share) {
        const float scale = 1.0f - 0.5f * share;
        return Half{18.0f * scale, 12.0f * scale, 12.0f * scale};
    };
    const ScanFeatures f = trunk(narrower_upwards);
    const SeenMeasures woman = seen_of(f, true), man = seen_of(f, false);
    const float whole = 0.01f * ellipse(18.0f, 12.0f);
    EXPECT_NEAR(woman.waist_girth_m, whole * (1.0f - 0.5f * 0.328f), 0.02f);
    EXPECT_NEAR(man.waist_girth_m - woman.waist_girth_m, whole * 0.5f * 0.02f, 0.002f);
    EXPECT_GT(woman.hip_girth_m, whole);
}

TEST(SeenMeasures, ASquareSectionIsLongerThanAnEllipseOfItsBreadthAndDepth) {
    ScanFeatures f = trunk([](float) { return Half{17.0f, 11.0f, 11.0f}; });
    const float round = seen_of(f, true).waist_girth_m;
    for (int l = 0; l < TrunkProfile::kLevels; ++l)
        for (int q = 1; q <= 3; ++q)
            f[kFrontReaches + size_t(l) * TrunkProfile::kReachesFromFront +
              size_t(TrunkProfile::kAhead + q)] = 8.0f;  // as far as in the middle
    EXPECT_GT(seen_of(f, true).waist_girth_m, round + 0.01f);
}

TEST(SeenMeasures, AnArmThatHidesTheOutlineAtSomeLevelsIsNoPartOfIt) {
    ScanFeatures f = trunk([](float) { return Half{17.0f, 11.0f, 11.0f}; });
    const float clear = seen_of(f, true).waist_girth_m;
    for (const int level : {11, 12, 13})
        f[kSideReaches + size_t(level) * TrunkProfile::kReaches + TrunkProfile::kAhead] = 30.0f;
    EXPECT_NEAR(seen_of(f, true).waist_girth_m, clear, 0.001f);
}

TEST(SeenMeasures, WhatNoViewShowsIsNotTold) {
    ScanFeatures f = trunk([](float) { return Half{17.0f, 11.0f, 11.0f}; });
    for (size_t i = kSideReaches; i < kSideReaches + size_t(TrunkProfile::kLevels) * TrunkProfile::kReaches;
         ++i)
        f[i] = std::nanf("");
    const SeenMeasures seen = seen_of(f, true);
    EXPECT_TRUE(std::isnan(seen.waist_girth_m) && std::isnan(seen.hip_girth_m) &&
                std::isnan(seen.chest_girth_m));
    EXPECT_EQ(seen.stature_m, 1.75f);
}

}  // namespace
}  // namespace vfit
