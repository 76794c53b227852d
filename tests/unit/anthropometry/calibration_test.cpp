// Calibration to a shop's own tape.
#include "anthropometry/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"

namespace vfit {
namespace {

/// A scan whose sigma is half of its true deviation, and a tape that reads 2 cm more at the waist.
struct Shop {
    std::mt19937 random{7};
    std::pair<Measurement, Measurement> person() {
        std::normal_distribution<float> error(0.0f, 0.02f);
        std::uniform_real_distribution<float> waist(0.6f, 1.2f);
        const float truth = waist(random);
        return {{"waist_girth_m", truth + error(random), 0.01f, true},
                {"waist_girth_m", truth + 0.02f, 0.0f, true}};
    }
    Calibration of(uint32_t people) {
        Calibration out;
        for (uint32_t i = 0; i < people; ++i) {
            const auto [scan, tape] = person();
            out.add({scan}, {tape});
        }
        return out;
    }
};

TEST(Calibration, LearnsOffsetAndHonestIntervals) {
    Shop shop;
    const Calibration calibration = shop.of(400);
    const auto told = calibration.measures();
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0].people, 400u);
    EXPECT_TRUE(told[0].enough);
    EXPECT_NEAR(told[0].offset, 0.02f, 0.004f);
    EXPECT_NEAR(told[0].widening, 2.0f, 0.25f);
}

TEST(Calibration, NineOfTenFurtherPeopleLieWithinTheInterval) {
    // The guarantee is of the mean over shops, whatever they met first.
    int inside = 0, all = 0;
    Shop shop;
    for (int i = 0; i < 200; ++i) {
        const Calibration calibration = shop.of(Calibration::kFewestPeople);
        for (int k = 0; k < 20; ++k) {
            const auto [scan, tape] = shop.person();
            const Measurement m = calibration.apply({scan})[0];
            inside += std::abs(m.value - tape.value) <= 1.645f * m.sigma;
            ++all;
        }
    }
    EXPECT_GE(double(inside) / all, 0.89);
    EXPECT_LE(double(inside) / all, 0.95) << "ten scores are coarse, but no wider than they must be";
}

TEST(Calibration, TooFewPeopleChangeNothing) {
    Shop shop;
    const Calibration calibration = shop.of(Calibration::kFewestPeople - 1);
    EXPECT_FALSE(calibration.measures()[0].enough);
    const Measurement scan{"waist_girth_m", 0.8f, 0.01f, true};
    EXPECT_EQ(calibration.apply({scan})[0].value, scan.value);
    EXPECT_EQ(calibration.apply({scan})[0].sigma, scan.sigma);
}

TEST(Calibration, OneMistypedPersonDoesNotMoveTheOffset) {
    Shop shop;
    Calibration calibration = shop.of(41);
    const float offset = calibration.measures()[0].offset;
    calibration.add({{"waist_girth_m", 0.8f, 0.01f, true}}, {{"waist_girth_m", 3.0f, 0.0f, true}});
    calibration.add({{"waist_girth_m", 0.8f, 0.01f, true}}, {{"waist_girth_m", 3.0f, 0.0f, true}});
    EXPECT_NEAR(calibration.measures()[0].offset, offset, 0.01f);
}

TEST(Calibration, OtherMeasuresAndThoseWithoutSigmaStayAsTheyAre) {
    Shop shop;
    const auto out =
        shop.of(30).apply({{"stature_m", 1.7f, 0.01f, true}, {"waist_girth_m", 0.8f, 0.0f, true}});
    EXPECT_EQ(out[0].value, 1.7f);
    EXPECT_EQ(out[1].value, 0.8f);
    EXPECT_EQ(out[1].sigma, 0.0f);
}

TEST(Calibration, IsKeptAsText) {
    Shop shop;
    const Calibration one = shop.of(30), back = Calibration::parse(one.text());
    EXPECT_EQ(back.people(), 30u);
    EXPECT_EQ(back.text(), one.text());
    EXPECT_EQ(back.measures()[0].offset, one.measures()[0].offset);
    EXPECT_EQ(Calibration::parse(Calibration().text()).people(), 0u);
}

TEST(Calibration, SaysWhatIsWrong) {
    const auto refused = [](const std::string& json, vfit_result code, const std::string& word) {
        try {
            Calibration::parse(json);
            ADD_FAILURE() << json;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), code) << json;
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    const auto file = [](const std::string& rest) {
        return R"({"format": "vfit-calibration", "version": 1, )" + rest + "}";
    };
    refused("{", VFIT_ERROR_DATA, "JSON");
    refused("[]", VFIT_ERROR_DATA, "format");
    refused(R"({"format": "vfit-calibration", "version": 2})", VFIT_ERROR_VERSION, "version 1");
    refused(file(R"("people": 1)"), VFIT_ERROR_DATA, "measures");
    refused(file(R"("people": -1, "measures": {})"), VFIT_ERROR_DATA, "people");
    refused(file(R"("people": 1, "measures": {"nose_m": []})"), VFIT_ERROR_DATA, "nose_m");
    refused(file(R"("people": 1, "measures": {"stature_m": [{}, {}]})"), VFIT_ERROR_DATA, "1 people");
    refused(file(R"("people": 1, "measures": {"stature_m": [{"error": 1}]})"), VFIT_ERROR_DATA, "sigma");
    refused(file(R"("people": 1, "measures": {"stature_m": [{"error": 1, "sigma": 0}]})"), VFIT_ERROR_DATA,
            "above 0");
    refused(file(R"("people": 1, "measures": {"stature_m": [{"error": 3e38, "sigma": 1}]})"), VFIT_ERROR_DATA,
            "no person's");
    refused(file(R"("people": 1, "measures": {"stature_m": [{"error": 1, "sigma": 1e-38}]})"),
            VFIT_ERROR_DATA, "above 0");
    refused(file(R"("people": 20000, "measures": {})"), VFIT_ERROR_DATA, "people");
    Calibration calibration;
    const Measurement scan{"waist_girth_m", 0.8f, 0.01f, true}, other{"hip_girth_m", 1.0f, 0.0f, true};
    EXPECT_THROW(calibration.add({scan}, {other}), Error);
    EXPECT_THROW(calibration.add({other}, {other}), Error) << "a scan without sigma";
    EXPECT_THROW(calibration.add({scan}, {scan, scan}), Error) << "twice: what is written must be read again";
    EXPECT_THROW(calibration.add({{"waist_girth_m", 0.8f, 1e-30f, true}}, {scan}), Error);
    EXPECT_EQ(calibration.people(), 0u);
}

TEST(Calibration, ASigmaThatIsKnownStaysAboveZero) {
    Calibration calibration;
    for (uint32_t i = 0; i < Calibration::kFewestPeople; ++i)
        calibration.add({{"waist_girth_m", 0.8f, 0.01f, true}}, {{"waist_girth_m", 0.8f, 0.0f, true}});
    EXPECT_GT(calibration.apply({{"waist_girth_m", 0.9f, 0.01f, true}})[0].sigma, 0.0005f);
}

}  // namespace
}  // namespace vfit
