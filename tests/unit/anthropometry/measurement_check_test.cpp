// Numbers from outside: what can be a person's, and what is in another unit.
#include "anthropometry/measurement_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "core/error.h"

namespace vfit {
namespace {

Measurement plain(const char* key, float value, float sigma = 0.0f) { return {key, value, sigma, true}; }

std::string refusal(const Measurement& m) {
    try {
        check_measurement(m, "profile: ");
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), VFIT_ERROR_DATA);
        return e.what();
    }
    ADD_FAILURE() << m.key << ": " << m.value << " is taken";
    return "";
}

void expect_words(const std::string& sentence, std::initializer_list<const char*> words) {
    for (const char* word : words)
        EXPECT_NE(sentence.find(word), std::string::npos) << word << ": " << sentence;
}

TEST(MeasurementCheck, NamesKeyValueBoundsAndTheProbableUnit) {
    EXPECT_EQ(
        refusal(plain("stature_m", 172.0f)),
        "profile: stature_m: the value 172 is not plausible: a person has 0.28 to 3 m; it is probably in "
        "centimetres, and must be in metres");
    expect_words(refusal(plain("stature_m", 1720.0f)), {"1720", "millimetres"});
    expect_words(refusal(plain("stature_m", 68.0f)), {"centimetres or inches"});
    expect_words(refusal(plain("stature_m", 5.6f)), {"feet"});
    expect_words(refusal(plain("neck_girth_m", 38.0f)), {"neck_girth_m", "38", "1.3 m", "centimetres"});
    expect_words(refusal(plain("body_mass_kg", 71500.0f)), {"body_mass_kg", "700 kg", "grams", "kilograms"});
    expect_words(refusal(plain("x_calf_girth_m", 38.0f)), {"x_calf_girth_m", "4 m", "centimetres"});
    for (const float value : {0.00172f, 1e30f}) {
        const std::string sentence = refusal(plain("stature_m", value));
        expect_words(sentence, {"stature_m", "not plausible", "0.28 to 3 m"});
        EXPECT_EQ(sentence.find("probably"), std::string::npos) << sentence;
    }
}

TEST(MeasurementCheck, RefusesWhatIsNoMeasurement) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const float value : {nan, inf, -inf, 0.0f, -1.0f})
        expect_words(refusal(plain("stature_m", value)), {"stature_m", "value"});
    for (const float sigma : {nan, inf, -0.1f})
        expect_words(refusal(plain("stature_m", 1.7f, sigma)), {"stature_m", "sigma"});
    expect_words(refusal(plain("wingspan_m", 1.7f)), {"wingspan_m", "is no measure"});
}

// Newborns at the third percentile and below (WHO child growth standards), and the records of each kind.
TEST(MeasurementCheck, TakesNewbornsAndTheLargestPeople) {
    for (const Measurement& m :
         {plain("stature_m", 0.436f), plain("chest_girth_m", 0.28f), plain("waist_girth_m", 0.26f),
          plain("neck_girth_m", 0.17f), plain("upper_arm_girth_m", 0.08f), plain("inside_leg_m", 0.14f),
          plain("hand_length_m", 0.055f), plain("head_width_m", 0.08f), plain("body_mass_kg", 1.9f)})
        EXPECT_NO_THROW(check_measurement(m)) << m.key;
    for (const Measurement& m :
         {plain("stature_m", 2.72f), plain("chest_girth_m", 3.15f), plain("waist_girth_m", 3.02f),
          plain("hand_length_m", 0.324f), plain("body_mass_kg", 635.0f), plain("hip_girth_m", 2.44f)})
        EXPECT_NO_THROW(check_measurement(m)) << m.key;
    EXPECT_NO_THROW(check_measurement(plain("x_little_toe_m", 0.01f)));
}

}  // namespace
}  // namespace vfit
