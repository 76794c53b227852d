// What known measures make likely of the others, and which of them may be wrong.
#include "anthropometry/population_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "anthropometry/measure_doubts.h"
#include "core/error.h"
#include "core/json.h"

namespace vfit {
namespace {

/// Two measures of one deviation each (0.04 and 0.1 of their value), correlated by r.
std::string small_text(double r = 0.5) {
    const auto people = [&](double stature, double waist) {
        return Json{{"keys", {"age_years", "stature_m", "waist_girth_m"}},
                    {"mean", {45.0, std::log(stature), std::log(waist)}},
                    {"covariance", {{225.0}, {0.0, 0.0016}, {0.3, r * 0.004, 0.01}}}};
    };
    return Json{{"format", "vfit-population"},
                {"version", 1},
                {"name", "small"},
                {"women", people(1.63, 0.80)},
                {"men", people(1.76, 0.92)}}
        .dump();
}

const PopulationModel& adults() {
    static const PopulationModel model = [] {
        std::ifstream file(VFIT_SOURCE_DIR "/assets/populations/adults.json");
        std::ostringstream text;
        text << file.rdbuf();
        return PopulationModel::parse(text.str());
    }();
    return model;
}

float value(const std::vector<Measurement>& list, const char* key) {
    const Measurement* m = find(list, key);
    return m ? m->value : NAN;
}
float sigma(const std::vector<Measurement>& list, const char* key) {
    const Measurement* m = find(list, key);
    return m ? m->sigma : NAN;
}

TEST(PopulationModel, ConditionsOnWhatIsKnown) {
    const auto model = PopulationModel::parse(small_text());
    // An exact stature one deviation above the mean: the waist is r of its own above its own.
    const float stature = 1.63f * std::exp(0.04f);
    const auto m = model.estimate({VFIT_SEX_FEMALE, {}}, {{"stature_m", stature, 1e-6f, true}});
    EXPECT_NEAR(value(m, "waist_girth_m"), 0.80f * std::exp(0.5f * 0.1f), 1e-4f);
    EXPECT_NEAR(sigma(m, "waist_girth_m") / value(m, "waist_girth_m"), 0.1f * std::sqrt(0.75f), 1e-4f);
    EXPECT_NEAR(value(m, "stature_m"), stature, 1e-5f);
    EXPECT_TRUE(find(m, "stature_m")->observed);
    EXPECT_FALSE(find(m, "waist_girth_m")->observed);
}

TEST(PopulationModel, AMeasureWithErrorCountsByItsVariance) {
    const auto model = PopulationModel::parse(small_text(0.0));
    // As unsure as the population: halfway between both.
    const auto m =
        model.estimate({VFIT_SEX_MALE, {}}, {{"stature_m", 1.76f * 1.1f, 0.04f * 1.76f * 1.1f, true}});
    EXPECT_NEAR(value(m, "stature_m"), 1.76f * std::sqrt(1.1f), 1e-3f);
}

TEST(PopulationModel, AgeMovesWhatGoesWithIt) {
    const auto model = PopulationModel::parse(small_text());
    const auto young = model.estimate({VFIT_SEX_MALE, 25.0f}, {}),
               old = model.estimate({VFIT_SEX_MALE, 65.0f}, {});
    // 0.3 / 225 a year.
    EXPECT_NEAR(std::log(value(old, "waist_girth_m") / value(young, "waist_girth_m")), 40.0 * 0.3 / 225.0,
                1e-3);
    EXPECT_NEAR(value(old, "stature_m"), value(young, "stature_m"), 1e-5f);
    for (const float age : {17.0f, 101.0f, -1.0f, NAN})
        EXPECT_THROW(model.estimate({VFIT_SEX_MALE, age}, {}), Error) << age;
}

TEST(PopulationModel, MixesTheSexesByHowWellTheMeasuresSuitThem) {
    const auto model = PopulationModel::parse(small_text());
    const Person unknown;
    EXPECT_NEAR(model.probability_female(unknown, {}), 0.5, 1e-9);
    EXPECT_GT(model.probability_female(unknown, {{"stature_m", 1.55f, 0.0f, true}}), 0.95);
    EXPECT_LT(model.probability_female(unknown, {{"stature_m", 1.90f, 0.0f, true}}), 0.05);
    EXPECT_EQ(model.probability_female({VFIT_SEX_MALE, {}}, {{"stature_m", 1.55f, 0.0f, true}}), 0.0);
    const auto m = model.estimate(unknown, {});
    EXPECT_NEAR(value(m, "stature_m"), std::sqrt(1.63f * 1.76f), 1e-3f);
    EXPECT_GT(sigma(m, "stature_m"), 1.05f * sigma(model.estimate({VFIT_SEX_MALE, {}}, {}), "stature_m"));
}

TEST(PopulationModel, OrderDoesNotMatter) {
    std::vector<Measurement> known = {{"underbust_girth_m", 0.75f, 0.0f, true},
                                      {"stature_m", 1.75f, 0.0f, true},
                                      {"body_mass_kg", 70.0f, 0.0f, true}};
    const auto one = adults().estimate({}, known);
    std::reverse(known.begin(), known.end());
    const auto other = adults().estimate({}, known);
    EXPECT_NEAR(value(one, "hip_girth_m"), value(other, "hip_girth_m"), 1e-5f);
    EXPECT_NEAR(sigma(one, "underbust_girth_m"), 0.025f * 0.75f, 1e-6f) << "as it was typed";
    // However clear the sex is: it was not told.
    known.push_back({"shoulder_breadth_m", 0.40f, 0.001f, true});
    known.push_back({"neck_girth_m", 0.30f, 0.001f, true});
    EXPECT_EQ(adults().estimate({}, known).size(), one.size());
}

TEST(PopulationModel, PassesThroughWhatItDoesNotHave) {
    const auto model = PopulationModel::parse(small_text());
    const auto m = model.estimate({}, {{"x_calf_girth_m", 0.37f, 0.01f, true}});
    EXPECT_FLOAT_EQ(value(m, "x_calf_girth_m"), 0.37f);
    EXPECT_EQ(m.size(), 3u);
    EXPECT_THROW(model.estimate({}, {{"stature_m", 1.7f, 0.0f, true}, {"stature_m", 1.7f, 0.0f, true}}),
                 Error);
}

TEST(PopulationModel, RefusesWhatIsNoPopulationAndNamesTheFault) {
    const auto refused = [](const auto& change, const char* named) {
        Json file = Json::parse(small_text());
        change(file);
        try {
            PopulationModel::parse(file.dump());
            ADD_FAILURE() << named;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
        }
    };
    refused([](Json& f) { f["format"] = "other"; }, "format");
    refused([](Json& f) { f["version"] = 2; }, "version 2");
    refused([](Json& f) { f.erase("men"); }, "men");
    refused([](Json& f) { f["women"]["keys"][1] = "height"; }, "height");
    refused([](Json& f) { f["women"]["keys"][2] = "stature_m"; }, "twice");
    refused([](Json& f) { f["women"]["keys"][0] = "waist_girth_m"; }, "age_years");
    refused([](Json& f) { f["women"]["mean"].erase(2); }, "2 means");
    refused([](Json& f) { f["women"]["mean"][1] = "tall"; }, "stature_m");
    refused([](Json& f) { f["men"]["covariance"][1] = {0.1}; }, "row 2");
    refused([](Json& f) { f["men"]["covariance"][2][1] = 1.0; }, "positive definite");
    refused([](Json& f) { f["men"]["mean"][1] = 800.0; }, "not plausible");
    refused([](Json& f) { f["men"]["covariance"][1][1] = 30.0; }, "logarithm");
    EXPECT_THROW(PopulationModel::parse("{"), Error);
    EXPECT_THROW(PopulationModel::parse("[]"), Error);
}

TEST(PopulationModel, BrokenTextIsRefusedOrGivesNumbers) {
    const std::string text = small_text();
    const auto use = [](const std::string& broken) {
        try {
            const auto model = PopulationModel::parse(broken);
            for (const Measurement& m : model.estimate({}, {{"stature_m", 1.7f, 0.0f, true}})) {
                EXPECT_TRUE(std::isfinite(m.value)) << broken;
                EXPECT_TRUE(std::isfinite(m.sigma)) << broken;
            }
        } catch (const Error&) {
        }
    };
    for (size_t n = 0; n < text.size(); ++n) {
        use(text.substr(0, n));
        for (const char byte : {'9', '-', '.', 'e', '[', ',', '"', '}'}) {
            std::string changed = text;
            changed[n] = byte;
            use(changed);
        }
    }
}

TEST(Adults, TellAllMeasuresFromHeightAndWeight) {
    // Means of ANSUR II near that stature and mass: chest 1.04, waist at the navel 0.92, hip 1.01 m.
    const auto man = adults().estimate(
        {VFIT_SEX_MALE, 30.0f}, {{"stature_m", 1.76f, 0.0f, true}, {"body_mass_kg", 83.0f, 0.0f, true}});
    EXPECT_NEAR(value(man, "chest_girth_m"), 1.04f, 0.03f);
    EXPECT_NEAR(value(man, "waist_navel_girth_m"), 0.92f, 0.03f);
    EXPECT_NEAR(value(man, "hip_girth_m"), 1.02f, 0.03f);
    EXPECT_LT(value(man, "waist_minimum_girth_m"), value(man, "waist_navel_girth_m") + 0.005f);
    EXPECT_EQ(find(man, "underbust_girth_m"), nullptr);
    for (const Measurement& m : man) {
        EXPECT_GT(m.sigma, 0.0f) << m.key;
        EXPECT_LT(m.sigma, 0.12f * m.value) << m.key;
    }
    const auto woman = adults().estimate(
        {VFIT_SEX_FEMALE, {}}, {{"stature_m", 1.63f, 0.0f, true}, {"body_mass_kg", 68.0f, 0.0f, true}});
    EXPECT_NE(find(woman, "underbust_girth_m"), nullptr);
    EXPECT_GT(value(woman, "chest_girth_m"), value(woman, "underbust_girth_m"));
}

TEST(Adults, EachAnswerNarrowsTheIntervals) {
    std::vector<Measurement> known = {{"stature_m", 1.70f, 0.0f, true}};
    float before = sigma(adults().estimate({VFIT_SEX_FEMALE, {}}, known), "hip_girth_m");
    const float first = before;
    for (const Measurement& more : {Measurement{"body_mass_kg", 70.0f, 0.0f, true},
                                    {"waist_girth_m", 0.80f, 0.0f, true},
                                    {"chest_girth_m", 0.97f, 0.0f, true}}) {
        known.push_back(more);
        const float now = sigma(adults().estimate({VFIT_SEX_FEMALE, {}}, known), "hip_girth_m");
        EXPECT_LE(now, before) << more.key;
        before = now;
    }
    EXPECT_LT(before, 0.5f * first);
}

std::vector<Measurement> usual_man() {
    return {{"stature_m", 1.80f, 0.0f, true},
            {"body_mass_kg", 82.0f, 0.0f, true},
            {"chest_girth_m", 1.02f, 0.0f, true},
            {"waist_girth_m", 0.89f, 0.0f, true},
            {"hip_girth_m", 1.02f, 0.0f, true}};
}

TEST(MeasureDoubts, HasNoneOfUsualPeople) {
    for (const vfit_sex sex : {VFIT_SEX_MALE, VFIT_SEX_UNKNOWN})
        EXPECT_TRUE(find_doubts(adults(), {sex, {}}, usual_man()).empty());
    EXPECT_TRUE(find_doubts(adults(), {}, {}).empty());
    EXPECT_TRUE(find_doubts(adults(), {}, {{"x_calf_girth_m", 3.0f, 0.0f, true}}).empty());
}

TEST(MeasureDoubts, NamesTheSlip) {
    struct Case {
        size_t item;
        float typed;
        vfit_doubt_kind kind;
        float meant;
    };
    // 35 inches for 35 cm; 181 pounds for 181 kg; 108 for 180 cm; 202 for 102 cm.
    for (const Case& c : {Case{3, 0.35f, VFIT_DOUBT_INCHES, 0.889f},
                          {1, 181.0f, VFIT_DOUBT_POUNDS, 82.1f},
                          {0, 1.08f, VFIT_DOUBT_DIGIT, 1.80f},
                          {4, 2.02f, VFIT_DOUBT_DIGIT, 1.02f}}) {
        auto known = usual_man();
        known[c.item].value = c.typed;
        const auto doubts = find_doubts(adults(), {VFIT_SEX_MALE, {}}, known);
        ASSERT_EQ(doubts.size(), 1u) << known[c.item].key;
        EXPECT_EQ(doubts[0].key, known[c.item].key);
        EXPECT_EQ(doubts[0].kind, c.kind) << doubts[0].suggested;
        EXPECT_NEAR(doubts[0].suggested, c.meant, 0.05f * c.meant);
        EXPECT_FLOAT_EQ(doubts[0].value, c.typed);
        EXPECT_NEAR(doubts[0].expected, usual_man()[c.item].value, 2.5f * doubts[0].sigma);
    }
}

TEST(MeasureDoubts, NamesWhatChangedPlaces) {
    auto known = usual_man();
    std::swap(known[0].value, known[3].value);
    const auto doubts = find_doubts(adults(), {VFIT_SEX_MALE, {}}, known);
    ASSERT_EQ(doubts.size(), 1u);
    EXPECT_EQ(doubts[0].kind, VFIT_DOUBT_SWAPPED);
    EXPECT_EQ(doubts[0].key, "stature_m");
    EXPECT_EQ(doubts[0].other_key, "waist_girth_m");
    EXPECT_FLOAT_EQ(doubts[0].suggested, 1.80f);
}

TEST(MeasureDoubts, FindsTwoSlipsOfOneList) {
    auto known = usual_man();
    known[1].value = 181.0f, known[3].value = 0.35f;
    const auto doubts = find_doubts(adults(), {VFIT_SEX_MALE, {}}, known);
    ASSERT_EQ(doubts.size(), 2u);
    EXPECT_NE(doubts[0].key, doubts[1].key);
}

TEST(MeasureDoubts, AllGirthsInInchesAreOneSlip) {
    auto known = usual_man();
    for (size_t i = 2; i < known.size(); ++i) known[i].value /= 2.54f;
    const auto doubts = find_doubts(adults(), {VFIT_SEX_MALE, {}}, known);
    ASSERT_EQ(doubts.size(), 3u);
    for (size_t i = 0; i < doubts.size(); ++i) {
        EXPECT_EQ(doubts[i].kind, VFIT_DOUBT_INCHES) << doubts[i].key;
        EXPECT_NEAR(doubts[i].suggested, usual_man()[i + 2].value, 1e-4f);
        EXPECT_NEAR(doubts[i].expected, usual_man()[i + 2].value, 2.5f * doubts[i].sigma);
    }
}

TEST(MeasureDoubts, NamesWhatWasGiven) {
    // Hopeless lists too: each key once, with the value that it had.
    const std::vector<Measurement> known = {{"stature_m", 1.72f, 0.0f, true},
                                            {"body_mass_kg", 154.0f, 0.0f, true},
                                            {"chest_girth_m", 0.36f, 0.0f, true},
                                            {"waist_girth_m", 0.30f, 0.0f, true},
                                            {"hip_girth_m", 0.39f, 0.0f, true}};
    const auto doubts = find_doubts(adults(), {VFIT_SEX_FEMALE, {}}, known);
    EXPECT_GE(doubts.size(), 3u);
    for (size_t i = 0; i < doubts.size(); ++i) {
        EXPECT_FLOAT_EQ(doubts[i].value, find(known, doubts[i].key)->value);
        for (size_t k = 0; k < i; ++k) EXPECT_NE(doubts[i].key, doubts[k].key);
    }
    EXPECT_THROW(
        find_doubts(adults(), {VFIT_SEX_MALE, {}},
                    {{"underbust_girth_m", 0.75f, 0.0f, true}, {"underbust_girth_m", 0.75f, 0.0f, true}}),
        Error);
}

TEST(MeasureDoubts, TellsWhatNoSlipExplains) {
    auto known = usual_man();
    known[3].value = 1.27f,
    known[3].sigma = 0.01f;  // none of 27, 17, ... 127 cm or inches goes with the rest
    const auto doubts = find_doubts(adults(), {VFIT_SEX_MALE, {}}, known);
    ASSERT_FALSE(doubts.empty());
    EXPECT_EQ(doubts[0].key, "waist_girth_m");
}

}  // namespace
}  // namespace vfit
