// What the measures that a person knows make likely of the others, through the C ABI.
#include <cmath>
#include <string>

#include "contract/support.h"

namespace {

vfit_measurement typed(const char* key, float value) {
    vfit_measurement m = vfit_measurement_init();
    std::snprintf(m.key, sizeof m.key, "%s", key);
    m.value = value, m.observed = 1;
    return m;
}

class PopulationTest : public contract::ContextTest {
protected:
    void SetUp() override {
        contract::ContextTest::SetUp();
        ASSERT_EQ(vfit_population_open(context, "adults", &population_), VFIT_OK);
    }
    vfit_result estimate(const std::vector<vfit_measurement>& known, std::vector<vfit_measurement>& out) {
        uint32_t count = 0;
        const vfit_result result =
            vfit_population_estimate(population_, &person_, known.data(), sizeof(vfit_measurement),
                                     uint32_t(known.size()), nullptr, sizeof(vfit_measurement), &count);
        if (result != VFIT_OK) return result;
        out.assign(count, vfit_measurement_init());
        return vfit_population_estimate(population_, &person_, known.data(), sizeof(vfit_measurement),
                                        uint32_t(known.size()), out.data(), sizeof out[0], &count);
    }

    vfit_population population_{};
    vfit_person person_ = vfit_person_init();
    const std::vector<vfit_measurement> known_ = {typed("stature_m", 1.78f), typed("body_mass_kg", 80.0f)};
};

}  // namespace

TEST_F(PopulationTest, AShortListBecomesAFullOne) {
    person_.sex = VFIT_SEX_MALE;
    std::vector<vfit_measurement> all;
    ASSERT_EQ(estimate(known_, all), VFIT_OK);
    EXPECT_GT(all.size(), 20u);
    uint32_t observed = 0;
    for (const vfit_measurement& m : all) {
        observed += m.observed;
        EXPECT_GT(m.value, 0.0f) << m.key;
        EXPECT_GT(m.sigma, 0.0f) << m.key;
    }
    EXPECT_EQ(observed, 2u);
    // An avatar and a size come out of it.
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = VFIT_SEX_MALE;
    vfit_avatar avatar{};
    EXPECT_EQ(vfit_avatar_create(context, &desc, all.data(), sizeof all[0], uint32_t(all.size()), &avatar),
              VFIT_OK);
    vfit_size_chart chart{};
    ASSERT_EQ(vfit_size_chart_open(context, "en13402_men", &chart), VFIT_OK);
    uint32_t sizes = 0;
    EXPECT_EQ(vfit_size_recommend(chart, "jacket", all.data(), sizeof all[0], uint32_t(all.size()), nullptr,
                                  sizeof(vfit_size), &sizes),
              VFIT_OK);
    EXPECT_GT(sizes, 3u);
}

TEST_F(PopulationTest, NothingKnownIsThePopulationItself) {
    std::vector<vfit_measurement> all;
    EXPECT_EQ(estimate({}, all), VFIT_OK);
    EXPECT_GT(all.size(), 20u);
    uint32_t count = 0;
    EXPECT_EQ(vfit_population_estimate(population_, nullptr, nullptr, sizeof(vfit_measurement), 0, nullptr,
                                       sizeof(vfit_measurement), &count),
              VFIT_OK)
        << "the person may be null";
}

TEST_F(PopulationTest, ASlipIsNamed) {
    auto known = known_;
    known.push_back(typed("waist_girth_m", 0.34f));
    known.push_back(typed("hip_girth_m", 1.0f));
    person_.sex = VFIT_SEX_MALE;
    vfit_doubt doubt = vfit_doubt_init();
    uint32_t count = 1;
    ASSERT_EQ(vfit_population_check(population_, &person_, known.data(), sizeof known[0], 4, &doubt,
                                    sizeof doubt, &count),
              VFIT_OK);
    ASSERT_EQ(count, 1u);
    EXPECT_STREQ(doubt.key, "waist_girth_m");
    EXPECT_EQ(doubt.kind, VFIT_DOUBT_INCHES);
    EXPECT_NEAR(doubt.suggested, 0.8636f, 1e-4f);
}

TEST_F(PopulationTest, WrongArgumentsAreNamed) {
    std::vector<vfit_measurement> all;
    for (const float age : {-5.0f, 12.0f, 200.0f, NAN}) {
        person_.age_years = age;
        EXPECT_EQ(estimate(known_, all), VFIT_ERROR_ARGUMENT) << age;
    }
    person_ = vfit_person_init();
    person_.sex = 9;
    EXPECT_EQ(estimate(known_, all), VFIT_ERROR_ARGUMENT);
    person_ = vfit_person_init();
    EXPECT_EQ(estimate({typed("stature_m", 178.0f)}, all), VFIT_ERROR_DATA) << "centimetres";
    EXPECT_EQ(estimate({typed("stature_m", NAN)}, all), VFIT_ERROR_DATA);
    EXPECT_EQ(estimate({typed("nose_length_m", 0.05f)}, all), VFIT_ERROR_DATA);
    EXPECT_EQ(estimate({known_[0], known_[0]}, all), VFIT_ERROR_DATA) << "known twice";
    vfit_population none{};
    EXPECT_EQ(vfit_population_load(context, "{}", 2, &none), VFIT_ERROR_DATA);
    EXPECT_EQ(vfit_population_load(context, nullptr, 2, &none), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_population_load(context, "{}", UINT64_MAX, &none), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_population_open(context, "martians", &none), VFIT_ERROR_IO);
    EXPECT_EQ(vfit_population_open(context, "../charts/paper", &none), VFIT_ERROR_ARGUMENT);
    uint32_t count = 0;
    EXPECT_EQ(vfit_population_estimate(none, nullptr, nullptr, 64, 0, nullptr, 64, &count),
              VFIT_ERROR_HANDLE);
    EXPECT_EQ(vfit_population_check(population_, nullptr, nullptr, 64, 3, nullptr, 64, &count),
              VFIT_ERROR_ARGUMENT);
    ASSERT_EQ(vfit_population_destroy(population_), VFIT_OK);
    EXPECT_EQ(estimate(known_, all), VFIT_ERROR_HANDLE) << "stale";
}

TEST_F(PopulationTest, ThoseOfTheDataFolderAreListed) {
    vfit_data_name name = vfit_data_name_init();
    uint32_t count = 1;
    ASSERT_EQ(vfit_population_list(context, &name, sizeof name, &count), VFIT_OK);
    EXPECT_STREQ(name.name, "adults");
}
