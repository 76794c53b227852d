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

Measurement waist(float value, float sigma) { return {"waist_girth_m", value, sigma, true}; }

TEST(Recommend, TakesTheLabelThatAllMeasuresMissLeast) {
    EXPECT_GT(of(recommend(chart(), "dress", {chest(0.98f, 0.005f), waist(0.78f, 0.005f)}), "M"), 0.999f);
    // A chest of S, half a centimetre from M; a waist of M by three.
    EXPECT_GT(of(recommend(chart(), "dress", {chest(0.935f, 0.002f), waist(0.77f, 0.002f)}), "M"), 0.999f);
    EXPECT_GT(of(recommend(chart(), "dress", {chest(0.91f, 0.002f), waist(0.745f, 0.002f)}), "S"), 0.999f);
}

TEST(Recommend, AMeasureThatIsKnownExactlyLeavesTheOthersDistribution) {
    // The waist stands on the border: the chest alone decides.
    const float by_chest = of(recommend(chart(), "dress", {chest(0.95f, 0.02f)}), "M");
    EXPECT_NEAR(of(recommend(chart(), "dress", {chest(0.95f, 0.02f), waist(0.74f, 0.0f)}), "M"), by_chest,
                0.02f);
}

TEST(Recommend, WeighsTheMeasuresAsTheChartSays) {
    const auto by_weight = [](const char* weights) {
        const std::string text =
            std::string(
                R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "cm", "garments": [
          {"kind": "dress", "measures": ["chest_girth_m", "waist_girth_m"], )") +
            weights + R"("sizes": [
            {"label": "S", "ranges": {"chest_girth_m": [86, 94], "waist_girth_m": [66, 74]}},
            {"label": "M", "ranges": {"chest_girth_m": [94, 102], "waist_girth_m": [74, 82]}}]}]})";
        return of(recommend(SizeChart::parse(text), "dress", {chest(0.90f, 0.005f), waist(0.80f, 0.005f)}),
                  "M");
    };
    EXPECT_GT(by_weight(""), 0.9f) << "4 cm of chest against 6 of waist";
    EXPECT_LT(by_weight(R"("weights": {"waist_girth_m": 0.2}, )"), 0.1f);
}

TEST(Recommend, SaysTheSameEachTime) {
    const std::vector<Measurement> measures = {chest(0.95f, 0.02f), waist(0.75f, 0.03f)};
    EXPECT_EQ(of(recommend(chart(), "dress", measures), "M"), of(recommend(chart(), "dress", measures), "M"));
}

SizeChart other_chart() {
    return SizeChart::parse(
        R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "in", "mass_unit": "lb", "garments": [
      {"kind": "jeans", "between": "/", "axes": [
        {"measure": "waist_girth_m", "sizes": [{"label": "W30", "range": [29, 31]}, {"label": "W32", "range": [31, 33]}]},
        {"measure": "inside_leg_m", "sizes": [{"label": "L30", "range": [29, 31]}, {"label": "L32", "range": [31, 33]}]}]},
      {"kind": "wetsuit", "table": {
        "rows": {"measure": "body_mass_kg", "values": [120, 160, 200]},
        "columns": {"measure": "stature_m", "values": [64, 70]},
        "labels": [["S", "S"], ["M", "M"], ["L", "M"]]}}]})");
}

TEST(Recommend, JoinsTheLabelsOfTwoAxes) {
    const Measurement leg{"inside_leg_m", 32 * 0.0254f, 0.005f, true};
    const auto sizes = recommend(other_chart(), "jeans", {waist(30 * 0.0254f, 0.005f), leg});
    ASSERT_EQ(sizes.size(), 4u);
    EXPECT_EQ(sizes[0].label, "W30/L32");
    EXPECT_GT(sizes[0].probability, 0.999f);
    const auto by_leg = recommend(other_chart(), "jeans", {leg});
    EXPECT_NEAR(of(by_leg, "W30/L32"), 0.5f, 1e-4f) << "nothing is known of the waist";
    EXPECT_NEAR(of(by_leg, "W32/L32"), 0.5f, 1e-4f);
}

TEST(Recommend, ErrorsOfOnePersonGoPartlyTogether) {
    // Both on the border. Were errors independent each of the four labels had a quarter; with a correlation
    // of 0.3 both are on the same side in 1/2 + asin(0.3) / pi.
    const auto sizes = recommend(other_chart(), "jeans",
                                 {waist(31 * 0.0254f, 0.004f), {"inside_leg_m", 31 * 0.0254f, 0.004f, true}});
    const float same = of(sizes, "W30/L30") + of(sizes, "W32/L32");
    EXPECT_NEAR(same, 0.5 + std::asin(0.3) / 3.14159265, 0.015);
}

TEST(Recommend, ReadsATableByHeightAndWeight) {
    const auto label = [](double lb, double inch) {
        return recommend(other_chart(), "wetsuit",
                         {{"body_mass_kg", float(lb * 0.45359237), 0.5f, true},
                          {"stature_m", float(inch * 0.0254), 0.003f, true}})[0]
            .label;
    };
    EXPECT_EQ(label(100, 60), "S") << "beyond the table: its nearest cell";
    EXPECT_EQ(label(155, 70), "M");
    EXPECT_EQ(label(200, 64), "L");
    EXPECT_EQ(label(230, 75), "M");
    const auto sizes = recommend(other_chart(), "wetsuit", {{"body_mass_kg", 90.0f, 3.0f, true}});
    ASSERT_EQ(sizes.size(), 3u) << "each label once";
    EXPECT_NEAR(of(sizes, "L"), of(sizes, "M"), 0.1f);
}

TEST(SizeZones, TellEaseAndWhatIsTight) {
    const auto zones = size_zones(chart(), "dress", "M", {waist(0.88f, 0.01f), chest(0.98f, 0.01f)});
    ASSERT_EQ(zones.size(), 2u);
    EXPECT_EQ(zones[0].key, "chest_girth_m") << "in the garment's order";
    EXPECT_NEAR(zones[0].ease, 0.0f, 1e-6f);
    EXPECT_NEAR(zones[0].regular, normal_cdf(4) - normal_cdf(-4), 1e-5);
    EXPECT_NEAR(zones[1].ease, 0.78f - 0.88f, 1e-6f);
    EXPECT_GT(zones[1].tight, 0.999f);
    for (const SizeZone& z : zones) EXPECT_NEAR(z.tight + z.regular + z.loose, 1.0f, 1e-5f);
    const auto large = size_zones(chart(), "top", "L", {chest(0.98f, 0.01f)});
    EXPECT_GT(large[0].loose, 0.999f);
    EXPECT_THROW(size_zones(chart(), "top", "XL", {chest(0.98f, 0.01f)}), Error);
    EXPECT_THROW(size_zones(chart(), "top", "L", {waist(0.8f, 0.01f)}), Error);
    EXPECT_THROW(size_zones(other_chart(), "wetsuit", "M", {{"stature_m", 1.7f, 0.0f, true}}), Error)
        << "a label of many ranges";
    EXPECT_EQ(size_zones(other_chart(), "jeans", "W32/L30", {waist(0.8f, 0.01f)}).size(), 1u);
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
