// Algorithm 4's mean and deviation.
#include "paper/averaging.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vfit {
namespace {

TEST(Averaging, IsMeanAndSampleDeviation) {
    std::vector<float> values{1.68f, 1.70f, 1.72f, 1.70f};
    const Averaged a = average(values);
    EXPECT_FLOAT_EQ(a.mean, 1.70f);
    EXPECT_NEAR(a.deviation, std::sqrt((0.0004f + 0.0004f) / 3), 1e-6f);
    EXPECT_EQ(a.kept, 4u);
}

TEST(Averaging, LeavesOutFramesThatArePlainlyWrong) {
    std::vector<float> values{0.471f, 0.475f, 0.468f, 0.473f, 0.470f, 1.30f, 0.20f};
    const Averaged a = average(values);
    EXPECT_EQ(a.kept, 5u);
    EXPECT_NEAR(a.mean, 0.4714f, 1e-4f);
}

TEST(Averaging, TakesThemInWhereThePapersPlainMeanIsAsked) {
    std::vector<float> values{0.4f, 0.5f, 0.6f, 2.5f};
    const Averaged a = average(values, Outliers::kKeep);
    EXPECT_EQ(a.kept, 4u);
    EXPECT_FLOAT_EQ(a.mean, 1.0f);
}

TEST(Averaging, KeepsValuesThatDifferByRounding) {
    std::vector<float> values{1.700f, 1.700f, 1.700f, 1.704f};
    EXPECT_EQ(average(values).kept, 4u);
}

TEST(Averaging, OfOneOrNone) {
    std::vector<float> none, one{0.3f};
    EXPECT_EQ(average(none).kept, 0u);
    EXPECT_EQ(average(one).mean, 0.3f);
    EXPECT_EQ(average(one).deviation, 0.0f);
}

}  // namespace
}  // namespace vfit
