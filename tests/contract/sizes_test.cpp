// Measurements that an app keeps, and how a size sits, through the C ABI.
#include <cstring>
#include <string>

#include "contract/support.h"

namespace {

vfit_measurement measurement(const char* key, float value, float sigma) {
    vfit_measurement m = vfit_measurement_init();
    std::snprintf(m.key, sizeof m.key, "%s", key);
    m.value = value, m.sigma = sigma, m.observed = 1;
    return m;
}

class SizesTest : public contract::ContextTest {
protected:
    const std::vector<vfit_measurement> some_ = {measurement("stature_m", 1.7f, 0.01f),
                                                 measurement("chest_girth_m", 0.98f, 0.02f)};
    const uint32_t count_ = 2;
};

}  // namespace

TEST_F(SizesTest, MeasurementsComeBackFromTheirText) {
    uint32_t capacity = 0;
    ASSERT_EQ(
        vfit_measurements_write(some_.data(), sizeof some_[0], count_, VFIT_SEX_MALE, nullptr, &capacity),
        VFIT_OK);
    std::string text(capacity, 'x');
    uint32_t short_by_one = capacity - 1;
    EXPECT_EQ(vfit_measurements_write(some_.data(), sizeof some_[0], count_, VFIT_SEX_MALE, text.data(),
                                      &short_by_one),
              VFIT_ERROR_CAPACITY);
    EXPECT_EQ(short_by_one, capacity) << "what is needed";
    EXPECT_EQ(text[0], 'x') << "nothing is written on an error";
    ASSERT_EQ(
        vfit_measurements_write(some_.data(), sizeof some_[0], count_, VFIT_SEX_MALE, text.data(), &capacity),
        VFIT_OK);
    EXPECT_EQ(text.back(), 0);

    uint32_t count = 0;
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    ASSERT_EQ(
        vfit_measurements_read(text.data(), capacity - 1, nullptr, sizeof(vfit_measurement), &count, &sex),
        VFIT_OK);
    EXPECT_EQ(count, 2u);
    EXPECT_EQ(sex, VFIT_SEX_MALE);
    std::vector<vfit_measurement> back(2, vfit_measurement_init());
    ASSERT_EQ(vfit_measurements_read(text.data(), capacity - 1, back.data(), sizeof back[0], &count, nullptr),
              VFIT_OK);
    EXPECT_STREQ(back[0].key, "stature_m");
    EXPECT_EQ(back[1].value, some_[1].value);
    EXPECT_EQ(vfit_measurements_read(text.data(), 10, nullptr, sizeof(vfit_measurement), &count, nullptr),
              VFIT_ERROR_DATA);
    EXPECT_EQ(
        vfit_measurements_read(text.data(), UINT64_MAX, nullptr, sizeof(vfit_measurement), &count, nullptr),
        VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_measurements_read(nullptr, 10, nullptr, sizeof(vfit_measurement), &count, nullptr),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_measurements_write(nullptr, sizeof some_[0], 2, 0, nullptr, &capacity),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_measurements_write(some_.data(), sizeof some_[0], count_, 9, nullptr, &capacity),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_measurements_write(some_.data(), sizeof some_[0], count_, 0, nullptr, nullptr),
              VFIT_ERROR_ARGUMENT);
}

TEST_F(SizesTest, ScansAreCalibratedToATape) {
    std::string text;
    const auto add = [&](const vfit_measurement& scan, const vfit_measurement& tape) {
        uint32_t capacity = 0;
        const void* before = text.empty() ? nullptr : text.data();
        const vfit_result result = vfit_calibration_add(before, text.size(), &scan, sizeof scan, 1, &tape,
                                                        sizeof tape, 1, nullptr, &capacity);
        if (result != VFIT_OK) return result;
        std::string out(capacity, 0);
        uint32_t short_by_one = capacity - 1;
        EXPECT_EQ(vfit_calibration_add(before, text.size(), &scan, sizeof scan, 1, &tape, sizeof tape, 1,
                                       out.data(), &short_by_one),
                  VFIT_ERROR_CAPACITY);
        EXPECT_EQ(vfit_calibration_add(before, text.size(), &scan, sizeof scan, 1, &tape, sizeof tape, 1,
                                       out.data(), &capacity),
                  VFIT_OK);
        out.resize(capacity - 1);
        text = out;
        return result;
    };
    const vfit_measurement scan = measurement("waist_girth_m", 0.8f, 0.01f);
    for (int i = 0; i < 20; ++i)
        ASSERT_EQ(add(scan, measurement("waist_girth_m", 0.82f, 0.0f)), VFIT_OK) << contract::last_error();
    vfit_calibrated_measure told = vfit_calibrated_measure_init();
    uint32_t count = 1;
    ASSERT_EQ(vfit_calibration_measures(text.data(), text.size(), &told, sizeof told, &count), VFIT_OK);
    EXPECT_STREQ(told.key, "waist_girth_m");
    EXPECT_EQ(told.people, 20u);
    EXPECT_EQ(told.enough, 1u);
    EXPECT_NEAR(told.offset, 0.02f, 1e-5f);
    vfit_measurement out = vfit_measurement_init();
    ASSERT_EQ(
        vfit_calibration_apply(text.data(), text.size(), &scan, sizeof scan, 1, &out, sizeof out, &count),
        VFIT_OK);
    EXPECT_NEAR(out.value, 0.82f, 1e-5f);
    EXPECT_GT(out.sigma, 0.0f) << "0 is unknown";
    EXPECT_EQ(add(scan, measurement("hip_girth_m", 1.0f, 0.0f)), VFIT_ERROR_DATA);
    EXPECT_NE(contract::last_error().find("in common"), std::string::npos);
    EXPECT_EQ(vfit_calibration_measures("{}", 2, &told, sizeof told, &count), VFIT_ERROR_DATA);
    EXPECT_EQ(vfit_calibration_measures(nullptr, 0, &told, sizeof told, &count), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_calibration_measures(text.data(), UINT64_MAX, &told, sizeof told, &count),
              VFIT_ERROR_ARGUMENT);
    uint32_t capacity = 0;
    EXPECT_EQ(
        vfit_calibration_add(nullptr, 5, &scan, sizeof scan, 1, &scan, sizeof scan, 1, nullptr, &capacity),
        VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(
        vfit_calibration_add(nullptr, 0, &scan, sizeof scan, 1, &scan, sizeof scan, 1, nullptr, nullptr),
        VFIT_ERROR_ARGUMENT);
}

TEST_F(SizesTest, TwoScansOfOnePersonAreMerged) {
    const vfit_measurement again[] = {measurement("stature_m", 1.71f, 0.01f),
                                      measurement("hip_girth_m", 1.0f, 0.02f)};
    std::vector<vfit_measurement> out(8, vfit_measurement_init());
    uint32_t count = 8;
    ASSERT_EQ(vfit_measurements_merge(some_.data(), sizeof some_[0], count_, again, sizeof again[0], 2,
                                      out.data(), sizeof out[0], &count),
              VFIT_OK);
    ASSERT_EQ(count, 3u);
    EXPECT_NEAR(out[0].value, 1.705f, 1e-5f);
    const vfit_measurement other = measurement("stature_m", 1.5f, 0.01f);
    EXPECT_EQ(vfit_measurements_merge(some_.data(), sizeof some_[0], count_, &other, sizeof other, 1,
                                      out.data(), sizeof out[0], &count),
              VFIT_ERROR_DATA);
    EXPECT_NE(contract::last_error().find("two people"), std::string::npos);
    EXPECT_EQ(vfit_measurements_merge(nullptr, sizeof other, 0, nullptr, sizeof other, 0, nullptr,
                                      sizeof other, &count),
              VFIT_OK);
    EXPECT_EQ(count, 0u);
}

TEST_F(SizesTest, TellHowASizeSits) {
    vfit_size_chart chart{};
    ASSERT_EQ(vfit_size_chart_open(context, "en13402_men", &chart), VFIT_OK) << contract::last_error();
    vfit_size_zone zones[4] = {vfit_size_zone_init(), vfit_size_zone_init(), vfit_size_zone_init(),
                               vfit_size_zone_init()};
    uint32_t count = 4;
    ASSERT_EQ(vfit_size_zones(chart, "short_sleeves", "S", some_.data(), sizeof some_[0], count_, zones,
                              sizeof zones[0], &count),
              VFIT_OK)
        << contract::last_error();
    ASSERT_EQ(count, 1u);
    EXPECT_STREQ(zones[0].key, "chest_girth_m");
    EXPECT_NEAR(zones[0].ease, 0.90f - 0.98f, 1e-5f);
    EXPECT_GT(zones[0].tight, 0.9f);
    EXPECT_EQ(vfit_size_zones(chart, "short_sleeves", "QQ", some_.data(), sizeof some_[0], count_, nullptr,
                              sizeof zones[0], &count),
              VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("XXL"), std::string::npos) << "names the labels that there are";
    EXPECT_EQ(vfit_size_zones(chart, "short_sleeves", nullptr, some_.data(), sizeof some_[0], count_, nullptr,
                              sizeof zones[0], &count),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_size_chart_destroy(chart), VFIT_OK);
}

TEST_F(SizesTest, ImplausibleMeasurementsAreRefusedWhereverTheyComeIn) {
    const vfit_measurement cm = measurement("stature_m", 172.0f, 0.0f);
    vfit_size_chart chart{};
    ASSERT_EQ(vfit_size_chart_open(context, "height_weight_men", &chart), VFIT_OK) << contract::last_error();
    uint32_t count = 0;
    const auto refused = [](vfit_result result) {
        EXPECT_EQ(result, VFIT_ERROR_DATA);
        for (const char* word : {"stature_m", "172", "0.28 to 3 m", "centimetres"})
            EXPECT_NE(contract::last_error().find(word), std::string::npos) << contract::last_error();
    };
    refused(
        vfit_size_recommend(chart, "short_sleeves", &cm, sizeof cm, 1, nullptr, sizeof(vfit_size), &count));
    refused(vfit_size_zones(chart, "short_sleeves", "M", &cm, sizeof cm, 1, nullptr, sizeof(vfit_size_zone),
                            &count));
    refused(vfit_measurements_merge(some_.data(), sizeof some_[0], count_, &cm, sizeof cm, 1, nullptr,
                                    sizeof(vfit_measurement), &count));
    refused(vfit_measurements_write(&cm, sizeof cm, 1, VFIT_SEX_UNKNOWN, nullptr, &count));
    const std::string text = R"({"stature_m": 172})";
    refused(
        vfit_measurements_read(text.data(), text.size(), nullptr, sizeof(vfit_measurement), &count, nullptr));
    vfit_avatar avatar{};
    refused(vfit_avatar_create(context, nullptr, &cm, sizeof cm, 1, &avatar));
    EXPECT_EQ(vfit_size_chart_destroy(chart), VFIT_OK);
}

TEST_F(SizesTest, OneSizeNeedsNoMeasurement) {
    const std::string text = R"({"format": "vfit-size-chart", "version": 1, "name": "t", "unit": "cm",
        "garments": [{"kind": "cap", "sizes": [{"label": "one size"}]}]})";
    vfit_size_chart chart{};
    ASSERT_EQ(vfit_size_chart_load(context, text.data(), text.size(), &chart), VFIT_OK)
        << contract::last_error();
    vfit_size_row row = vfit_size_row_init();
    uint32_t count = 1;
    ASSERT_EQ(vfit_size_chart_rows(chart, &row, sizeof row, &count), VFIT_OK);
    EXPECT_EQ(row.measure_count, 0u);
    vfit_size size = vfit_size_init();
    ASSERT_EQ(vfit_size_recommend(chart, "cap", nullptr, 0, 0, &size, sizeof size, &count), VFIT_OK)
        << contract::last_error();
    EXPECT_STREQ(size.label, "one size");
    EXPECT_EQ(size.probability, 1.0f);
    count = 7;
    EXPECT_EQ(vfit_size_zones(chart, "cap", "one size", some_.data(), sizeof some_[0], count_, nullptr,
                              sizeof(vfit_size_zone), &count),
              VFIT_OK);
    EXPECT_EQ(count, 0u);
    EXPECT_EQ(vfit_size_chart_destroy(chart), VFIT_OK);
}
