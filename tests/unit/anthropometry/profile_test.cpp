// Measurements as JSON and back, and two scans made one.
#include "anthropometry/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace vfit {
namespace {

std::vector<Measurement> some() {
    return {{"stature_m", 1.7123f, 0.0123f, true},
            {"waist_girth_m", 0.8f, 0.0f, false},
            {"body_mass_kg", 71.5f, 3.0f, false}};
}

void expect_refused(const std::string& json, const char* word, vfit_result code = VFIT_ERROR_DATA) {
    try {
        parse_profile(json);
        FAIL() << "taken: " << json;
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), code) << e.what();
        EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
}

TEST(Profile, ComesBackAsItWas) {
    const PersonProfile back = parse_profile(profile_text({VFIT_SEX_FEMALE, some()}));
    EXPECT_EQ(back.sex, VFIT_SEX_FEMALE);
    ASSERT_EQ(back.measurements.size(), 3u);
    for (const Measurement& m : some()) {
        const Measurement* b = find(back.measurements, m.key);
        ASSERT_TRUE(b) << m.key;
        EXPECT_EQ(b->value, m.value) << m.key;
        EXPECT_EQ(b->sigma, m.sigma) << m.key;
        EXPECT_EQ(b->observed, m.observed) << m.key;
    }
    EXPECT_EQ(parse_profile(profile_text({VFIT_SEX_UNKNOWN, {}})).measurements.size(), 0u);
}

TEST(Profile, ReadsReportsAndPlainNumbers) {
    EXPECT_FLOAT_EQ(parse_profile(R"({"stature_m": 1.8})").measurements[0].value, 1.8f);
    const PersonProfile report = parse_profile(
        R"({"method": "fit", "frames": 30, "measurements": {"stature_m": {"value": 1.8, "sigma": 0.02}}})");
    EXPECT_FLOAT_EQ(report.measurements[0].sigma, 0.02f);
    EXPECT_TRUE(report.measurements[0].observed);
}

TEST(Profile, SaysWhatIsWrong) {
    expect_refused("", "JSON");
    expect_refused("[]", "object");
    expect_refused(R"({"format": "other"})", "format");
    expect_refused(R"({"format": "vfit-profile", "version": 7, "measurements": {}})", "version 7",
                   VFIT_ERROR_VERSION);
    expect_refused(R"({"format": "vfit-profile", "measurements": {}})", "version");
    expect_refused(R"({"measurements": 3})", "measurements");
    expect_refused(R"({"height": 1.8})", "height");
    expect_refused(R"({"stature_m": "tall"})", "stature_m");
    expect_refused(R"({"stature_m": -1})", "stature_m");
    expect_refused(R"({"stature_m": {"sigma": 1}})", "value");
    expect_refused(R"({"stature_m": {"value": 1, "sigma": -1}})", "sigma");
    expect_refused(R"({"stature_m": {"value": 1, "observed": "yes"}})", "observed");
    expect_refused(R"({"sex": "x", "measurements": {}})", "sex");
    const std::string whole = profile_text({VFIT_SEX_MALE, some()});
    for (size_t n = 0; n + 1 < whole.size(); ++n) EXPECT_THROW(parse_profile(whole.substr(0, n)), Error) << n;
}

TEST(Merge, WeighsByVarianceAndHardlyGetsSurer) {
    const auto merged = merge({{"stature_m", 1.70f, 0.01f, true}},
                              {{"stature_m", 1.703f, 0.02f, false}, {"hip_girth_m", 1.0f, 0.02f, true}});
    ASSERT_EQ(merged.size(), 2u);
    EXPECT_EQ(merged[0].key, "stature_m");
    EXPECT_NEAR(merged[0].value, 1.7006f, 1e-5f);
    EXPECT_TRUE(merged[0].observed);
    EXPECT_EQ(merged[1].value, 1.0f) << "what one alone holds";
    const float alike =
        merge({{"waist_girth_m", 0.8f, 0.02f, true}}, {{"waist_girth_m", 0.8f, 0.02f, true}})[0].sigma;
    EXPECT_NEAR(alike, 0.02f * std::sqrt(0.6f + 0.4f / 2.0f), 1e-5f)
        << "0.6 of the variance comes again with every scan";
    const float apart =
        merge({{"waist_girth_m", 0.8f, 0.02f, true}}, {{"waist_girth_m", 0.9f, 0.02f, true}})[0].sigma;
    EXPECT_GT(apart, 0.04f) << "10 cm apart is more than either is unsure of";
}

TEST(Merge, TakesAnUnknownSigmaForWhatItIs) {
    EXPECT_EQ(merge({{"waist_girth_m", 0.8f, 0.0f, true}}, {{"waist_girth_m", 0.9f, 0.02f, true}})[0].value,
              0.9f);
    const auto both = merge({{"waist_girth_m", 0.8f, 0.0f, true}}, {{"waist_girth_m", 0.9f, 0.0f, true}});
    EXPECT_NEAR(both[0].value, 0.85f, 1e-6f);
    EXPECT_EQ(both[0].sigma, 0.0f);
}

TEST(Merge, RefusesTwoPeople) {
    EXPECT_THROW(merge({{"stature_m", 1.7f, 0.01f, true}}, {{"stature_m", 1.85f, 0.01f, true}}), Error);
    EXPECT_NO_THROW(merge({{"stature_m", 1.7f, 0.03f, true}}, {{"stature_m", 1.85f, 0.03f, true}}));
}

}  // namespace
}  // namespace vfit
