// Tables 1 and 2, Eq. 6 and 7 by hand.
#include "paper/proportions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace vfit {
namespace {

constexpr vfit_sex kAnybody = VFIT_SEX_UNKNOWN;

void set(Lines& lines, Line line, float value, float sigma = 0.01f) {
    at(lines, line) = {value, sigma, true};
}

TEST(Proportions, HoldTheCanonOfTable1) {
    const std::pair<Line, float> rows[] = {
        {Line::kHeadWidth, 1},     {Line::kHeadHeight, 1},     {Line::kBodyHeight, 7},
        {Line::kHipHeight, 4},     {Line::kElbowFingertip, 2}, {Line::kWristFingertip, 1},
        {Line::kShoulderWidth, 3}, {Line::kHipWidth, 0},       {Line::kTorsoHeight, 0}};
    for (const auto& [line, heads] : rows) EXPECT_EQ(ratio(RatioTable::kCanon, kAnybody, line).heads, heads);
}

TEST(Proportions, AverageTheDirectAndTheDerivedEstimatesAsEq7Does) {
    Lines lines{};
    set(lines, Line::kBodyHeight, 1.70f);
    set(lines, Line::kHipHeight, 0.92f);       // 0.92 x 7 / 4 = 1.61
    set(lines, Line::kElbowFingertip, 0.46f);  // 0.46 x 7 / 2 = 1.61
    set(lines, Line::kWristFingertip, 0.19f);  // 0.19 x 7     = 1.33
    set(lines, Line::kHeadHeight, 0.22f);      // 0.22 x 7     = 1.54
    const Estimate e =
        estimate_primary(lines, Line::kBodyHeight, RatioTable::kCanon, kAnybody, Combination::kMean);
    ASSERT_TRUE(e.known);
    EXPECT_NEAR(e.value_m, (1.70f + 1.61f + 1.61f + 1.33f + 1.54f) / 5, 1e-5f);
}

TEST(Proportions, NeverMixWidthsAndHeightsNorLinesWithoutARatio) {
    Lines lines{};
    set(lines, Line::kShoulderWidth, 0.48f);
    set(lines, Line::kHeadWidth, 0.15f);
    set(lines, Line::kBodyHeight, 1.9f);
    set(lines, Line::kHipWidth, 0.40f);
    set(lines, Line::kTorsoHeight, 0.60f);
    const auto width = [&](Line line) {
        return estimate_primary(lines, line, RatioTable::kCanon, kAnybody, Combination::kMean);
    };
    EXPECT_NEAR(width(Line::kShoulderWidth).value_m, (0.48f + 0.45f) / 2, 1e-6f);
    EXPECT_NEAR(width(Line::kHipWidth).value_m, 0.40f, 1e-6f) << "hip width stands alone";
    EXPECT_NEAR(width(Line::kTorsoHeight).value_m, 0.60f, 1e-6f);
}

TEST(Proportions, WeighEstimatesByTheirCertainty) {
    Lines lines{};
    set(lines, Line::kShoulderWidth, 0.48f, 0.02f);
    set(lines, Line::kHeadWidth, 0.16f, 0.01f);
    const Ratio r = ratio(RatioTable::kAnthropometric, VFIT_SEX_MALE, Line::kShoulderWidth);
    ASSERT_FLOAT_EQ(r.heads, 3.31f);
    const double derived = 0.16 * 3.31;
    const double s1 = 0.02 * 0.02, s2 = std::pow(0.01 * 3.31, 2) + std::pow(derived * r.relative_sd, 2);
    const Estimate e = estimate_primary(lines, Line::kShoulderWidth, RatioTable::kAnthropometric,
                                        VFIT_SEX_MALE, Combination::kInverseVariance);
    EXPECT_NEAR(e.value_m, (0.48 / s1 + derived / s2) / (1 / s1 + 1 / s2), 1e-5);
    EXPECT_NEAR(e.sigma_m, std::sqrt(1 / (1 / s1 + 1 / s2)), 1e-5);
}

TEST(Proportions, DropAWeighedLineThatContradictsTheDirectMeasure) {
    Lines lines{};
    set(lines, Line::kBodyHeight, 1.60f, 0.015f);
    const auto height = [&](Combination c) {
        return estimate_primary(lines, Line::kBodyHeight, RatioTable::kAnthropometric, kAnybody, c).value_m;
    };
    set(lines, Line::kElbowFingertip, 0.55f, 0.02f);  // an arm of a person of 2.17 m
    EXPECT_FLOAT_EQ(height(Combination::kInverseVariance), 1.60f);
    EXPECT_GT(height(Combination::kMean), 1.85f) << "the paper's mean takes it in";
}

TEST(Proportions, InferAPrimaryThatWasNotSeen) {
    Lines lines{};
    EXPECT_FALSE(
        estimate_primary(lines, Line::kBodyHeight, RatioTable::kCanon, kAnybody, Combination::kMean).known);
    set(lines, Line::kHipHeight, 0.90f, 0.01f);
    const Estimate e = estimate_primary(lines, Line::kBodyHeight, RatioTable::kAnthropometric, kAnybody,
                                        Combination::kInverseVariance);
    EXPECT_NEAR(e.value_m, 0.90f / 0.530f, 1e-4f);
    EXPECT_GT(e.sigma_m, 0.03f) << "people differ by 2.9 % in that ratio";
}

TEST(Proportions, TakeAnUnknownSexHalfway) {
    const auto shoulder = [](vfit_sex sex) {
        return ratio(RatioTable::kAnthropometric, sex, Line::kShoulderWidth).heads;
    };
    EXPECT_FLOAT_EQ(shoulder(kAnybody), 0.5f * (shoulder(VFIT_SEX_FEMALE) + shoulder(VFIT_SEX_MALE)));
}

TEST(Proportions, NameThePrimaryLinesOfTable2) {
    EXPECT_EQ(garment_kind("trousers").height, Line::kHipHeight);
    EXPECT_EQ(garment_kind("trousers").widths[0], Line::kHipWidth);
    EXPECT_EQ(garment_kind("short_sleeves").height, Line::kTorsoHeight);
    EXPECT_EQ(garment_kind("long_sleeves").height, Line::kBodyHeight);
    EXPECT_EQ(garment_kind("long_sleeves").width_count, 2u);
    try {
        garment_kind("hat");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), VFIT_ERROR_ARGUMENT);
        for (const char* word : {"hat", "trousers", "long_sleeves", "short_sleeves"})
            EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << word;
    }
}

}  // namespace
}  // namespace vfit
