// Steps of one measure: their borders agree with the distances that rank labels by several measures.
#include "size/measure_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "math/random.h"

namespace vfit {
namespace {

GarmentSizes garment_of(const std::vector<MeasureRange>& ranges) {
    GarmentSizes garment;
    garment.measures = {"waist_girth_m"};
    for (const MeasureRange& range : ranges) garment.sizes.push_back({"", {range}});
    return garment;
}

/// Ends that never descend: ranges that meet, overlap, leave gaps, contain each other.
std::vector<MeasureRange> random_ranges(Random& random) {
    std::vector<MeasureRange> out;
    float low = 0.5f, high = 0.5f + random.between(0.02f, 0.2f);
    for (int i = 0; i < 6; ++i) {
        out.push_back({"waist_girth_m", low, high});
        const bool keep_low = random.unit() < 0.2f, keep_high = !keep_low && random.unit() < 0.2f;
        if (!keep_high) high += random.between(0.01f, 0.15f);
        if (!keep_low) low = std::min(low + random.between(0.01f, 0.15f), high - 0.005f);
        if (low <= out.back().low && high <= out.back().high) high += 0.01f;
    }
    return out;
}

TEST(MeasureSteps, GiveEachValueToTheRangeThatItMissesLeastAndThenToTheNearestMiddle) {
    Random random(5);
    for (int chart = 0; chart < 300; ++chart) {
        const auto ranges = random_ranges(random);
        const MeasureSteps steps(garment_of(ranges), 0);
        ASSERT_EQ(steps.ranges().size(), ranges.size());
        for (int draw = 0; draw < 200; ++draw) {
            const double value = double(random.between(0.3f, 1.7f));
            size_t best = 0;
            const auto distance = [&](size_t i) {
                return std::pair(ranges[i].missed(value), std::abs(ranges[i].ease(value)));
            };
            for (size_t i = 1; i < ranges.size(); ++i)
                if (distance(i) < distance(best)) best = i;
            EXPECT_LE(steps.low(best), value + 1e-9) << chart;
            EXPECT_GE(steps.high(best), value - 1e-9) << chart;
        }
    }
}

TEST(MeasureSteps, LeaveNoValueWithoutAStep) {
    Random random(6);
    for (int chart = 0; chart < 300; ++chart) {
        const MeasureSteps steps(garment_of(random_ranges(random)), 0);
        const size_t last = steps.ranges().size() - 1;
        EXPECT_EQ(steps.low(0), -std::numeric_limits<double>::infinity());
        EXPECT_EQ(steps.high(last), std::numeric_limits<double>::infinity());
        for (size_t i = 0; i < last; ++i) {
            EXPECT_EQ(steps.high(i), steps.low(i + 1));
            EXPECT_LE(steps.low(i), steps.high(i));
        }
    }
}

TEST(MeasureSteps, CountNarrowStepsByWhatPeopleOfOneSizeDifferBy) {
    const std::string key = "inside_leg_m";
    EXPECT_NEAR(MeasureSteps(garment_of({{key, 0.80f, 0.81f}, {key, 0.81f, 0.82f}}), 0).scale(), 0.05 * 0.81,
                1e-6);
    EXPECT_NEAR(MeasureSteps(garment_of({{key, 0.80f, 0.90f}, {key, 0.90f, 1.02f}}), 0).scale(), 0.11, 1e-6);
}

}  // namespace
}  // namespace vfit
