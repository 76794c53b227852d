// The learnt estimator: what it reads, how it mixes sexes and how it doubts strangers.
#include "scan/measure_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "core/json.h"

namespace vfit {
namespace {

constexpr size_t kCrown = size_t(kFitShapes);

/// The models here look at shape, crown and the last feature: places in their lists.
constexpr size_t kLast = kCrown + 1, kUsed = kLast + 1;

std::vector<size_t> used() {
    std::vector<size_t> out(kUsed);
    std::iota(out.begin(), out.end(), size_t{0});
    out[kLast] = kScanFeatures - 1;
    return out;
}

std::vector<float> weights(float crown) {
    std::vector<float> w(kUsed, 0.0f);
    w[kCrown] = crown;
    return w;
}

constexpr float kUsualCrown_m = 1.7f;

/// Stature is the crown's height; women are 0.1 m shorter and have an underbust besides.
Json small_model() {
    const auto measure = [](float base, float log_sigma) {
        return Json{{"observed", true},
                    {"base", base},
                    {"weights", weights(1.0f)},
                    {"log_sigma", log_sigma},
                    {"sigma_weights", {0.5f, 0.0f}}};
    };
    std::vector<float> mean(kUsed, 0.0f);
    mean[kCrown] = kUsualCrown_m;
    const Json part = {
        {"features", used()},
        {"mean", mean},
        {"scale", std::vector<float>(kUsed, 1.0f)},
        {"directions", Json::array()},
        {"centres", Json::array()},
        {"bends", {{"stature_m", Json::array()}, {"underbust_girth_m", Json::array()}}},
        {"usual_strangeness", 1.0f},
        {"shape_precision", std::vector<float>(size_t(kFitComponents) * size_t(kFitComponents), 0.0f)},
        {"female_weights", weights(-1000.0f)},
        {"female_base", 0.0f},
        {"sigma_features", {kScanFeatures - 1}},
        {"female",
         {{"stature_m", measure(1.6f, std::log(0.01f))}, {"underbust_girth_m", measure(0.8f, 0.0f)}}},
        {"male", {{"stature_m", measure(1.7f, std::log(0.01f))}}}};
    const Json girth = {{"offset", 0.01f}, {"sigma", 0.02f}};
    Json girths;
    for (const std::string_view key : kTurnedKeys) girths[std::string(key)] = girth;
    const Json turned = {{"male", girths}, {"female", girths}};
    return {{"format", "vfit-measure-model"},
            {"version", 8},
            {"unit", 1.0f},
            {"unit_of_places", 1.0f},
            {"turn", {{"any", turned}, {"tight", turned}}},
            {"cameras", {{"any", turned}, {"tight", turned}}},
            {"front", part},
            {"front_and_side", part},
            {"front_tight", part},
            {"front_and_side_tight", part}};
}

ScanFeatures features(float crown, float last = 0.0f) {
    ScanFeatures f{};
    f[kCrown] = kUsualCrown_m + crown, f.back() = last;
    return f;
}

TEST(MeasureModel, IsLinearInWhatTheScanTells) {
    const MeasureModel model = MeasureModel::parse(json_text(small_model()));
    const auto male = model.measure(features(0.05f), ScanKind{}, VFIT_SEX_MALE);
    ASSERT_EQ(male.size(), 1u);
    EXPECT_EQ(male[0].key, "stature_m");
    EXPECT_NEAR(male[0].value, 1.75f, 1e-5f);
    EXPECT_NEAR(male[0].sigma, 0.01f, 1e-5f);
    EXPECT_NEAR(model.measure(features(0.05f, 2.0f), ScanKind{}, VFIT_SEX_MALE)[0].sigma,
                0.01f * std::exp(1.0f), 1e-4f);
}

TEST(MeasureModel, TakesWhatIsSeenAsItIs) {
    Json json = small_model();
    std::vector<float> by_shape = weights(0.0f);
    by_shape[0] = 0.1f;
    Json& stature = json["front"]["male"]["stature_m"];
    stature["base"] = 0.02f, stature["weights"] = weights(0.0f);
    stature["stand_in"] = {{"base", 1.7f}, {"weights", by_shape}, {"sigma", 0.03f}, {"trust", 1.0f}};
    MeasureModel model = MeasureModel::parse(json_text(json));
    const auto told = [&](float crown, float shape) {
        ScanFeatures f = features(crown);
        f[0] = shape;
        return model.measure(f, {}, VFIT_SEX_MALE)[0];
    };
    EXPECT_NEAR(told(0.05f, 0.0f).value, 1.75f + 0.02f, 1e-5f);
    EXPECT_NEAR(told(0.05f, 0.5f).value, 1.75f + 0.02f, 1e-5f) << "whatever the fitted body says";
    EXPECT_NEAR(told(0.05f, 0.0f).sigma, 0.01f, 1e-3f);
    const Measurement unseen = told(std::nanf(""), 1.0f), hat = told(0.5f, 1.0f);
    EXPECT_NEAR(unseen.value, 1.8f + 0.02f, 1e-5f);
    EXPECT_NEAR(unseen.sigma, std::hypot(0.01f, 0.03f), 1e-3f);
    EXPECT_NEAR(hat.value, 1.8f + 0.02f, 1e-5f) << "what no such body can have is something else";
    EXPECT_GT(hat.sigma, 0.03f);
    stature["stand_in"]["trust"] = 0.5f;
    model = MeasureModel::parse(json_text(json));
    EXPECT_NEAR(told(0.05f, 0.0f).value, 1.725f + 0.02f, 1e-5f);
}

TEST(MeasureModel, IsBentByWhatItIsNear) {
    Json json = small_model();
    json["unit"] = 0.01f, json["unit_of_places"] = 0.1f;
    for (const char* sex : {"female", "male"}) json["front"][sex]["stature_m"]["weights"][kCrown] = 100;
    std::vector<int> along_last(kUsed, 0);
    along_last[kLast] = 10;
    json["front"]["directions"] = along_last;
    json["front"]["centres"] = {0, 20};
    json["front"]["bends"] = {{"stature_m", {5, -2}}, {"underbust_girth_m", {0, 0}}};
    const MeasureModel model = MeasureModel::parse(json_text(json));
    const auto stature = [&](float last) {
        return model.measure(features(0.1f, last), {}, VFIT_SEX_MALE)[0].value;
    };
    EXPECT_NEAR(stature(0.0f), 1.8f + 0.05f - 0.02f * std::exp(-2.0f), 1e-5f);
    EXPECT_NEAR(stature(2.0f), 1.8f + 0.05f * std::exp(-2.0f) - 0.02f, 1e-5f);
    EXPECT_NEAR(stature(-5.0f), 1.8f, 1e-5f) << "far from all, the linear rule";
}

TEST(MeasureModel, IsLessSureOfAnUnlikelyShape) {
    Json json = small_model();
    // The first two values of a shape go together.
    json["front"]["shape_precision"][0] = json["front"]["shape_precision"][size_t(kFitComponents) + 1] = 1.0f;
    json["front"]["shape_precision"][1] = json["front"]["shape_precision"][size_t(kFitComponents)] = -0.9f;
    const MeasureModel model = MeasureModel::parse(json_text(json));
    const auto sigma = [&](float first, float second) {
        ScanFeatures f = features(0.0f);
        f[0] = first, f[1] = second;
        return model.measure(f, {}, VFIT_SEX_MALE)[0].sigma;
    };
    EXPECT_NEAR(sigma(2.0f, 2.0f), 0.01f, 1e-5f) << "2 * 4 * (1 - 0.9) < 1";
    EXPECT_NEAR(sigma(2.0f, -2.0f), 0.01f * std::sqrt(2 * 4 * 1.9f), 1e-4f);
    json["front"]["shape_precision"].erase(0);
    EXPECT_THROW(MeasureModel::parse(json_text(json)), Error);
}

TEST(MeasureModel, TakesTheMeanForWhatWasNotSeen) {
    Json json = small_model();
    json["front"]["mean"][kCrown] = 1.74f;
    const MeasureModel model = MeasureModel::parse(json_text(json));
    ScanFeatures unseen = features(std::nanf(""));
    unseen[3] = std::nanf("");
    EXPECT_NEAR(model.measure(unseen, {}, VFIT_SEX_MALE)[0].value, 1.7f, 1e-5f);
}

TEST(MeasureModel, KnowsEachKindOfScanByItself) {
    Json json = small_model();
    json["front_and_side_tight"]["male"]["stature_m"]["base"] = 1.9f;
    const MeasureModel model = MeasureModel::parse(json_text(json));
    EXPECT_NEAR(model.measure(features(0.0f), {.side = true, .tight = true}, VFIT_SEX_MALE)[0].value, 1.9f,
                1e-5f);
    EXPECT_NEAR(model.measure(features(0.0f), {.tight = true}, VFIT_SEX_MALE)[0].value, 1.7f, 1e-5f);
    EXPECT_NEAR(model.measure(features(0.0f), {.side = true}, VFIT_SEX_MALE)[0].value, 1.7f, 1e-5f);
}

TEST(MeasureModel, MixesBothWhereTheSexIsUnknown) {
    const MeasureModel model = MeasureModel::parse(json_text(small_model()));
    // Nobody knows: half of each, and their difference is doubt.
    const auto half = model.measure(features(std::nanf("")), {.side = true}, VFIT_SEX_UNKNOWN);
    ASSERT_EQ(half.size(), 1u) << "what women alone have is told where the sex is";
    EXPECT_NEAR(half[0].value, 1.65f, 1e-5f);
    EXPECT_NEAR(half[0].sigma, std::hypot(0.01f, 0.05f), 1e-4f);
    // Surely a woman: as if it had been told.
    EXPECT_NEAR(model.measure(features(-0.05f), {.side = true}, VFIT_SEX_UNKNOWN)[0].value, 1.55f, 1e-4f);
    EXPECT_GT(model.female_probability(features(-0.05f), {.side = true}), 0.999f);
    const auto female = model.measure(features(0.0f), {.side = true}, VFIT_SEX_FEMALE);
    ASSERT_EQ(female.size(), 2u);
    EXPECT_EQ(female[1].key, "underbust_girth_m");
}

TEST(MeasureModel, IsLessSureOfAPersonUnlikeAllOthers) {
    const MeasureModel model = MeasureModel::parse(json_text(small_model()));
    ScanFeatures strange{};
    std::fill(strange.begin(), strange.begin() + kCrown, 2.0f);
    strange[kCrown] = kUsualCrown_m, strange.back() = 0.0f;
    const float usual = float(kUsed) / float(kScanFeatures) / 4.0f;
    Json easily_surprised = small_model();
    for (const char* kind : {"front", "front_and_side"}) easily_surprised[kind]["usual_strangeness"] = usual;
    EXPECT_NEAR(
        MeasureModel::parse(json_text(easily_surprised)).measure(strange, ScanKind{}, VFIT_SEX_MALE)[0].sigma,
        0.04f * std::sqrt(float(kCrown) / float(kUsed)), 1e-3f);
    // One of the body's own numbers far out, as a child's crown is, is enough.
    Json json = small_model();
    json["front"]["scale"][kCrown] = 0.1f;
    json["front"]["male"]["stature_m"]["weights"][kCrown] = 0.1f;
    const MeasureModel in_decimetres = MeasureModel::parse(json_text(json));
    const auto sigma = [&](float crown) {
        return in_decimetres.measure(features(crown), {}, VFIT_SEX_MALE)[0].sigma;
    };
    EXPECT_NEAR(sigma(-0.3f), 0.01f, 1e-4f);
    EXPECT_GT(sigma(-0.5f), 0.035f);
    EXPECT_GT(sigma(-0.7f), 0.15f) << "the rule ends at five deviations: the crown contradicts it";
    ScanFeatures absurd{};
    absurd.fill(1e9f);
    const Measurement m = model.measure(absurd, ScanKind{}, VFIT_SEX_MALE)[0];
    EXPECT_TRUE(std::isfinite(m.value) && std::isfinite(m.sigma));
    EXPECT_GT(m.sigma, 0.1f);
}

TEST(MeasureModel, DeviationsFollowHowStrangeTheScanIs) {
    Json json = small_model();
    json["front"]["male"]["stature_m"]["sigma_weights"] = {0.0f, 0.5f};
    const MeasureModel model = MeasureModel::parse(json_text(json));
    ScanFeatures f = features(0.0f);
    const float usual = model.measure(f, {}, VFIT_SEX_MALE)[0].sigma;
    std::fill(f.begin(), f.begin() + kCrown, 2.0f);
    const float square = 4.0f * float(kCrown) / float(kScanFeatures);
    EXPECT_NEAR(model.measure(f, {}, VFIT_SEX_MALE)[0].sigma / usual, std::sqrt((square + 0.01f) / 0.01f),
                1e-3f);
}

TEST(MeasureModel, RefusesWhatIsNoModelAndNamesTheFault) {
    const auto refused = [](const Json& json, const char* word) {
        try {
            MeasureModel::parse(json_text(json));
            ADD_FAILURE() << "taken: " << word;
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
        }
    };
    EXPECT_THROW(MeasureModel::parse("{"), Error);
    EXPECT_THROW(MeasureModel::parse("[]"), Error);
    Json m = small_model();
    m["format"] = "else", refused(m, "format");
    m = small_model(), m["version"] = 2, refused(m, "version");
    m = small_model(), m.erase("front_and_side"), refused(m, "front_and_side");
    m = small_model(), m["front"]["mean"].erase(0), refused(m, "mean");
    m = small_model(), m["front"]["scale"][3] = 0.0f, refused(m, "scale");
    m = small_model(), m["front"]["features"] = Json::array(), refused(m, "features");
    m = small_model(), m["front"]["features"][0] = kScanFeatures, refused(m, "feature");
    m = small_model(), m["front"]["directions"] = 3, refused(m, "directions");
    m = small_model(), m["front"]["directions"] = weights(1.0f), m["front"]["centres"] = {0.0f, "x"},
    refused(m, "centres");
    m = small_model(), m["front"]["directions"] = weights(1.0f), m["front"]["centres"] = {0.0f},
    refused(m, "stature_m");
    m = small_model(), m["front"].erase("bends"), refused(m, "bends");
    m = small_model(), m.erase("unit"), refused(m, "unit");
    m = small_model(), m["front"]["sigma_features"] = {100000}, refused(m, "feature");
    m = small_model(), m["front"]["male"]["stature_m"]["weights"][2] = "x", refused(m, "stature_m");
    m = small_model(), m["front"]["male"] = {{"nose_m", m["front"]["male"]["stature_m"]}},
    refused(m, "nose_m");
    m = small_model(), m["front"]["male"] = Json::object(), refused(m, "male");
    m = small_model(), m["front"]["male"]["stature_m"]["stand_in"] = {{"base", 1.7f}},
    refused(m, "stature_m");
}

TEST(MeasureModel, TheOneThatComesWithTheLibraryIsRead) {
    const auto model = MeasureModel::load(VFIT_SOURCE_DIR "/assets/measures.json");
    const auto all = model->measure(ScanFeatures{}, {.side = true}, VFIT_SEX_FEMALE);
    EXPECT_GT(all.size(), 20u);
    EXPECT_NE(find(all, "chest_girth_m"), nullptr);
    const auto man = model->measure(ScanFeatures{}, {.side = true}, VFIT_SEX_MALE);
    EXPECT_EQ(find(man, "underbust_girth_m"), nullptr);
}

}  // namespace
}  // namespace vfit
