// A function of direction from samples with gaps.
#include "scan/even_waves.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "math/types.h"

namespace vfit {
namespace {

constexpr size_t kCount = 18;
using Samples = std::array<float, kCount>;

float angle(size_t i) { return kPi * float(i) / float(kCount); }

/// Breadths of an ellipse by direction, metres.
float breadth(float a, float b, float turned) {
    return 2.0f * std::hypot(a * std::cos(turned), b * std::sin(turned));
}

Samples ellipse(float a, float b) {
    Samples out;
    for (size_t i = 0; i < kCount; ++i) out[i] = breadth(a, b, angle(i));
    return out;
}

TEST(EvenWaves, AreThoseOfTheSamples) {
    Samples samples;
    for (size_t i = 0; i < kCount; ++i)
        samples[i] = 0.3f + 0.05f * std::cos(2 * angle(i)) - 0.02f * std::sin(2 * angle(i));
    const EvenWaves waves = fit_even_waves(samples);
    EXPECT_NEAR(waves.mean, 0.3f, 1e-4f);
    EXPECT_NEAR(waves.first_cos, 0.05f, 1e-3f);
    EXPECT_NEAR(waves.first_sin, -0.02f, 1e-3f);
    EXPECT_NEAR(waves.second_cos, 0.0f, 1e-3f);
}

TEST(EvenWaves, TheMeanBreadthGivesAnEllipsesPerimeter) {
    const float a = 0.17f, b = 0.11f, h = (a - b) * (a - b) / ((a + b) * (a + b));
    const float ramanujan = kPi * (a + b) * (1.0f + 3.0f * h / (10.0f + std::sqrt(4.0f - 3.0f * h)));
    EXPECT_NEAR(kPi * fit_even_waves(ellipse(a, b)).mean, ramanujan, 5e-4f);
}

TEST(EvenWaves, FillGapsByTheFormOfTheRest) {
    const float whole = fit_even_waves(ellipse(0.17f, 0.11f)).mean;
    Samples samples = ellipse(0.17f, 0.11f);
    float sum = 0.0f;
    for (const size_t i : {7, 8, 9, 10, 11}) samples[i] = std::nanf("");  // the least breadths
    for (const float s : samples) sum += std::isnan(s) ? 0.0f : s / 13.0f;
    EXPECT_GT(sum, whole + 0.01f) << "the mean of what is left is no answer";
    EXPECT_NEAR(fit_even_waves(samples).mean, whole, 0.003f);
}

TEST(EvenWaves, LeaveOutWhatLiesFarFromTheRest) {
    Samples samples = ellipse(0.17f, 0.11f);
    const float whole = fit_even_waves(samples).mean;
    samples[4] += 0.12f, samples[11] += 0.09f;
    EXPECT_NEAR(fit_even_waves(samples).mean, whole, 0.003f);
}

TEST(EvenWaves, AreNotGuessed) {
    Samples few, half = ellipse(0.17f, 0.11f), none;
    few.fill(std::nanf("")), none.fill(std::nanf(""));
    for (const size_t i : {0, 4, 8, 12, 16}) few[i] = 0.3f;
    for (size_t i = 0; i < 10; ++i) half[(i + 12) % kCount] = std::nanf("");  // over the end
    for (const Samples& samples : {few, half, none}) EXPECT_TRUE(std::isnan(fit_even_waves(samples).mean));
}

}  // namespace
}  // namespace vfit
