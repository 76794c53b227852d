// Probabilities of labels: they sum to 1, follow the value, and know how sure the measure is.
#include "size/recommend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace vfit {
namespace {

SizeChart chart() {
    return SizeChart::parse(
        R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "cm", "garments": [
      {"kind": "top", "measures": ["chest_girth_m"], "sizes": [
        {"label": "S", "ranges": {"chest_girth_m": [86, 94]}},
        {"label": "M", "ranges": {"chest_girth_m": [94, 102]}},
        {"label": "L", "ranges": {"chest_girth_m": [106, 114]}}]},
      {"kind": "dress", "measures": ["chest_girth_m", "waist_girth_m"], "sizes": [
        {"label": "S", "ranges": {"chest_girth_m": [86, 94], "waist_girth_m": [66, 74]}},
        {"label": "M", "ranges": {"chest_girth_m": [94, 102], "waist_girth_m": [74, 82]}}]}]})");
}

double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

float of(const std::vector<SizeProbability>& sizes, const std::string& label) {
    for (const SizeProbability& s : sizes)
        if (s.label == label) return s.probability;
    ADD_FAILURE() << label;
    return -1;
}

Measurement chest(float value, float sigma) { return {"chest_girth_m", value, sigma, true}; }

TEST(Recommend, IntegratesTheNormalDistributionOverEachRange) {
    const auto sizes = recommend(chart(), "top", {chest(0.97f, 0.03f)});
    EXPECT_NEAR(of(sizes, "S"), normal_cdf(-1.0), 1e-5) << "with the open tail below";
    EXPECT_NEAR(of(sizes, "M"), normal_cdf((1.04 - 0.97) / 0.03) - normal_cdf(-1.0), 1e-5)
        << "to the gap's middle";
    EXPECT_NEAR(of(sizes, "L"), 1 - normal_cdf((1.04 - 0.97) / 0.03), 1e-5);
    EXPECT_EQ(sizes[0].label, "M");
}

TEST(Recommend, SumsToOneAndFallsFromTheBest) {
    for (float value = 0.5f; value < 1.6f; value += 0.013f)
        for (const float sigma : {0.0f, 0.002f, 0.02f, 0.2f}) {
            const auto sizes = recommend(chart(), "top", {chest(value, sigma)});
            float sum = 0;
            for (const SizeProbability& s : sizes) {
                sum += s.probability;
                EXPECT_LE(s.probability, sizes[0].probability);
            }
            ASSERT_NEAR(sum, 1.0f, 1e-5f) << value << ' ' << sigma;
        }
}

TEST(Recommend, MovesUpWithTheValue) {
    float before = -1;
    for (float value = 0.80f; value < 1.3f; value += 0.01f) {
        const float l = of(recommend(chart(), "top", {chest(value, 0.03f)}), "L");
        EXPECT_GE(l, before);
        before = l;
    }
    EXPECT_GT(before, 0.99f);
    EXPECT_EQ(recommend(chart(), "top", {chest(0.40f, 0.01f)})[0].label, "S") << "smaller than the chart";
    EXPECT_EQ(recommend(chart(), "top", {chest(2.5f, 0.01f)})[0].label, "L") << "larger than the chart";
}

TEST(Recommend, TakesAnUnknownSigmaAsATapes) {
    const auto sizes = recommend(chart(), "top", {chest(0.98f, 0.0f)});
    EXPECT_NEAR(of(sizes, "M"), 1.0f, 1e-6f);
    EXPECT_NEAR(of(recommend(chart(), "top", {chest(0.94f, 0.0f)}), "M"), 0.5f, 1e-3f) << "on the border";
}

TEST(Recommend, MultipliesTheMeasuresThatAreGiven) {
    const Measurement waist{"waist_girth_m", 0.75f, 0.02f, true};
    const float by_chest = of(recommend(chart(), "dress", {chest(0.93f, 0.02f)}), "M");
    const float by_waist = of(recommend(chart(), "dress", {waist}), "M");
    const float both = of(recommend(chart(), "dress", {chest(0.93f, 0.02f), waist}), "M");
    const float product = by_chest * by_waist / (by_chest * by_waist + (1 - by_chest) * (1 - by_waist));
    EXPECT_NEAR(both, product, 1e-5f);
}

TEST(Recommend, StaysFiniteWhereMeasuresContradictEachOther) {
    const auto sizes =
        recommend(chart(), "dress", {chest(0.60f, 0.0f), {"waist_girth_m", 1.40f, 0.0f, true}});
    EXPECT_NEAR(sizes[0].probability + sizes[1].probability, 1.0f, 1e-5f);
    EXPECT_EQ(sizes[0].label, "M") << "the waist is further outside S than the chest outside M";
}

TEST(Recommend, StaysFiniteForMeasuresThatSayNothing) {
    for (const float sigma : {1e6f, 1e12f, 1e15f, 1e30f, std::numeric_limits<float>::max()})
        for (const float value : {0.9f, 0.98f, 1e10f, std::numeric_limits<float>::max()}) {
            float sum = 0;
            for (const SizeProbability& s : recommend(chart(), "top", {chest(value, sigma)})) {
                EXPECT_GE(s.probability, 0.0f);
                sum += s.probability;
            }
            EXPECT_NEAR(sum, 1.0f, 1e-5f) << value << ' ' << sigma;
        }
}

TEST(Recommend, NamesTheMeasuresThatItNeeds) {
    try {
        recommend(chart(), "dress", {{"stature_m", 1.7f, 0.01f, true}});
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), VFIT_ERROR_DATA);
        EXPECT_NE(std::string(e.what()).find("chest_girth_m, waist_girth_m"), std::string::npos) << e.what();
    }
}

TEST(Recommend, RefusesUnknownGarmentsAndBrokenMeasurements) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Measurement& m :
         {chest(nan, 0.01f), chest(-1.0f, 0.01f), chest(0.9f, nan), chest(0.9f, -0.1f)}) {
        try {
            recommend(chart(), "top", {m});
            ADD_FAILURE() << m.value << ' ' << m.sigma;
        } catch (const Error& e) {
            EXPECT_EQ(e.code(), VFIT_ERROR_ARGUMENT);
            EXPECT_NE(std::string(e.what()).find("chest_girth_m"), std::string::npos);
        }
    }
    EXPECT_THROW(recommend(chart(), "hat", {chest(0.9f, 0.01f)}), Error);
}

}  // namespace
}  // namespace vfit
