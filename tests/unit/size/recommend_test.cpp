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
        R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "in",
      "mass_unit": "lb", "garments": [
      {"kind": "jeans", "between": "/", "axes": [
        {"measure": "waist_girth_m", "sizes": [{"label": "W30", "range": [29, 31]},
          {"label": "W32", "range": [31, 33]}]},
        {"measure": "inside_leg_m", "sizes": [{"label": "L30", "range": [29, 31]},
          {"label": "L32", "range": [31, 33]}]}]},
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

Measurement inches(const char* key, double value, double sigma = 0.1) {
    return {key, float(value * 0.0254), float(sigma * 0.0254), true};
}

// Trousers of men and clothes of toddlers as two shops publish them.
SizeChart shops() {
    return SizeChart::parse(
        R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "in", "garments": [
      {"kind": "trousers", "measures": ["waist_girth_m", "hip_girth_m", "inside_leg_m"], "sizes": [
        {"label": "XS", "ranges": {"waist_girth_m": [26, 29], "hip_girth_m": [32, 35],
          "inside_leg_m": [31, 31]}},
        {"label": "S", "ranges": {"waist_girth_m": [29, 32], "hip_girth_m": [35, 37.5],
          "inside_leg_m": [32, 32]}},
        {"label": "M", "ranges": {"waist_girth_m": [32, 35], "hip_girth_m": [37.5, 41],
          "inside_leg_m": 32.5}},
        {"label": "L", "ranges": {"waist_girth_m": [35, 38], "hip_girth_m": [41, 44], "inside_leg_m": 32.75}},
        {"label": "XL", "ranges": {"waist_girth_m": [38, 43], "hip_girth_m": [44, 47], "inside_leg_m": 33}}]},
      {"kind": "toddler", "measures": ["chest_girth_m", "waist_girth_m", "stature_m"], "sizes": [
        {"label": "2T", "ranges": {"chest_girth_m": [20, 21], "waist_girth_m": [20, 21],
          "stature_m": [33, 35]}},
        {"label": "3T", "ranges": {"chest_girth_m": [20.5, 21.5], "waist_girth_m": [20.5, 21.5],
          "stature_m": [35, 38]}},
        {"label": "4T", "ranges": {"chest_girth_m": [21, 22], "waist_girth_m": [21, 22],
          "stature_m": [38, 41]}}]},
      {"kind": "length", "measures": ["inside_leg_m"], "sizes": [
        {"label": "short", "ranges": {"inside_leg_m": 30}},
          {"label": "regular", "ranges": {"inside_leg_m": 32}},
        {"label": "long", "ranges": {"inside_leg_m": 36}}]},
      {"kind": "cap", "sizes": [{"label": "one size"}]},
      {"kind": "cape", "measures": ["stature_m", "chest_girth_m"], "sizes": [
        {"label": "one size", "ranges": {"stature_m": [60, 76], "chest_girth_m": [null, 48]}}]},
      {"kind": "vest", "measures": ["chest_girth_m", "waist_girth_m"], "sizes": [
        {"label": "S", "ranges": {"chest_girth_m": [null, 36], "waist_girth_m": [28, 32]}},
        {"label": "L", "ranges": {"chest_girth_m": [36, null], "waist_girth_m": [32, 36]}}]}]})");
}

TEST(Recommend, ReadsAShopsSingleValuesBesideRanges) {
    const auto by = [](double waist, double hip, double leg) {
        return recommend(
            shops(), "trousers",
            {inches("waist_girth_m", waist), inches("hip_girth_m", hip), inches("inside_leg_m", leg)});
    };
    EXPECT_GT(of(by(36.5, 42.5, 32.75), "L"), 0.99f);
    EXPECT_GT(of(by(27.5, 33.5, 31), "XS"), 0.99f);
    // Legs say little of the size: 4.5 cm short of the chart's, they do not overrule both girths.
    const auto short_legs = by(36.5, 42.5, 31);
    EXPECT_GT(of(short_legs, "L") + of(short_legs, "M"), 0.99f);
    EXPECT_GT(of(by(36.5, 42.5, 34), "L"), 0.9f);
}

TEST(Recommend, DividesSingleValuesHalfway) {
    const auto leg = [](double value) {
        return recommend(shops(), "length", {inches("inside_leg_m", value, 0.5)});
    };
    EXPECT_NEAR(of(leg(31), "short"), 0.5f, 1e-3f);
    EXPECT_NEAR(of(leg(34), "regular"), 0.5f, 1e-3f);
    EXPECT_NEAR(of(leg(32), "regular"), normal_cdf(4.0) - normal_cdf(-2.0), 1e-4);
}

TEST(Recommend, DividesAnOverlapAtEqualDistanceFromTheMiddles) {
    const auto sizes = recommend(shops(), "toddler", {inches("chest_girth_m", 20.9, 0.2)});
    EXPECT_NEAR(of(sizes, "2T"), normal_cdf((20.75 - 20.9) / 0.2), 1e-4);
    EXPECT_NEAR(of(sizes, "4T"), 1 - normal_cdf((21.25 - 20.9) / 0.2), 1e-4);
    // The waist stands in the middle of the overlap of 2T and 3T: again the chest decides between them.
    const auto both = recommend(shops(), "toddler",
                                {inches("chest_girth_m", 20.9, 0.2), inches("waist_girth_m", 20.75, 0.0)});
    EXPECT_NEAR(of(both, "2T"), of(sizes, "2T"), 0.03f);
}

TEST(Recommend, PrefersTheLabelWhoseRangesHoldTheWholeBody) {
    const auto best = [](double chest, double waist, double stature) {
        return recommend(shops(), "toddler",
                         {inches("chest_girth_m", chest, 0.01), inches("waist_girth_m", waist, 0.01),
                          inches("stature_m", stature, 0.01)})[0]
            .label;
    };
    EXPECT_EQ(best(20.9, 20.9, 34), "2T") << "both girths are nearer to 3T's middles, but within 2T's ranges";
    EXPECT_EQ(best(20.6, 20.6, 36), "3T");
    EXPECT_EQ(best(21.4, 21.4, 36), "3T");
    EXPECT_EQ(best(21.4, 21.4, 39), "4T");
    EXPECT_EQ(best(19, 19, 30), "2T") << "smaller than the chart";
    EXPECT_EQ(best(23, 23, 44), "4T") << "larger than the chart";
}

TEST(Recommend, SumsToOneForEveryFormOfRange) {
    const SizeChart chart = shops();
    for (const GarmentSizes& garment : chart.garments())
        for (double shift = -3; shift <= 3; shift += 0.25) {
            std::vector<Measurement> body;
            for (size_t m = 0; m < garment.measures.size(); ++m) {
                const auto& range = garment.sizes[garment.sizes.size() / 2].ranges[m];
                body.push_back({garment.measures[m], float(range.middle() + 0.0254 * shift), 0.02f, true});
            }
            float sum = 0;
            for (const SizeProbability& s : recommend(chart, garment.kind, body)) {
                EXPECT_GE(s.probability, 0.0f);
                sum += s.probability;
            }
            EXPECT_NEAR(sum, 1.0f, 1e-5f) << garment.kind << ' ' << shift;
        }
}

TEST(Recommend, GivesOneSizeToEveryone) {
    for (const char* kind : {"cap", "cape"})
        for (const std::vector<Measurement>& body :
             {std::vector<Measurement>{}, {inches("waist_girth_m", 30)}, {inches("stature_m", 90)}}) {
            const auto sizes = recommend(shops(), kind, body);
            ASSERT_EQ(sizes.size(), 1u);
            EXPECT_EQ(sizes[0].label, "one size");
            EXPECT_EQ(sizes[0].probability, 1.0f);
        }
    EXPECT_THROW(recommend(shops(), "cape", {chest(-1.0f, 0.01f)}), Error)
        << "a broken measurement stays one";
}

TEST(Recommend, SharesEquallyWhatTheKnownMeasuresDoNotTellApart) {
    const SizeChart chart = SizeChart::parse(
        R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "cm", "garments": [
      {"kind": "suit", "between": "/", "axes": [
        {"measure": "chest_girth_m", "sizes": [{"label": "48", "range": [94, 98]},
          {"label": "50", "range": [98, 102]}]},
        {"measure": "waist_girth_m", "sizes": [{"label": "D4", "range": [84, 88]},
          {"label": "D6", "range": [88, 92]}]},
        {"measure": "stature_m", "sizes": [{"label": "short", "range": [165, 175]},
          {"label": "long", "range": [175, 185]}]},
        {"measure": "neck_girth_m", "sizes": [{"label": "any"}]}]}]})");
    const auto sizes = recommend(
        chart, "suit", {chest(0.96f, 0.0f), waist(0.90f, 0.0f), {"neck_girth_m", 0.4f, 0.0f, true}});
    EXPECT_NEAR(of(sizes, "48/D6/short/any"), 0.5f, 1e-3f);
    EXPECT_NEAR(of(sizes, "48/D6/long/any"), 0.5f, 1e-3f);
}

TEST(SizeZones, TellWhatLiesOutsideOneSize) {
    const auto zones =
        size_zones(shops(), "cape", "one size", {inches("stature_m", 80), inches("chest_girth_m", 40)});
    ASSERT_EQ(zones.size(), 2u);
    EXPECT_GT(zones[0].tight, 0.999f) << "taller than the range";
    EXPECT_GT(zones[1].regular, 0.999f) << "an open end has no outside";
    EXPECT_EQ(zones[1].ease, 0.0f);
    EXPECT_GT(size_zones(shops(), "cape", "one size", {inches("chest_girth_m", 50)})[0].tight, 0.999f);
    EXPECT_TRUE(size_zones(shops(), "cap", "one size", {inches("stature_m", 80)}).empty());
}

TEST(SizeZones, TakeAnOpenEndAsPartOfTheRange) {
    const auto of_chest = [](const char* label, double value) {
        return size_zones(shops(), "vest", label, {inches("chest_girth_m", value)})[0];
    };
    EXPECT_GT(of_chest("L", 50).regular, 0.999f);
    EXPECT_GT(of_chest("L", 34).loose, 0.999f);
    EXPECT_GT(of_chest("S", 20).regular, 0.999f);
    EXPECT_GT(of_chest("S", 38).tight, 0.999f);
    EXPECT_GT(of(recommend(shops(), "vest", {inches("chest_girth_m", 50), inches("waist_girth_m", 34)}), "L"),
              0.999f);
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
