// What data_dir holds: lists, and garments that fit the charts that they name.
#include <algorithm>
#include <cstring>
#include <set>

#include "contract/support.h"

namespace {

class DataTest : public contract::ContextTest {
protected:
    template <typename List>
    std::vector<std::string> names(List list) {
        uint32_t count = 0;
        EXPECT_EQ(list(context, nullptr, sizeof(vfit_data_name), &count), VFIT_OK) << contract::last_error();
        std::vector<vfit_data_name> entries(count, vfit_data_name_init());
        EXPECT_EQ(list(context, entries.data(), sizeof(vfit_data_name), &count), VFIT_OK);
        std::vector<std::string> out;
        for (const vfit_data_name& entry : entries) out.emplace_back(entry.name);
        return out;
    }
    /// Labels of that kind in that chart; empty: the chart does not know it.
    std::set<std::string> labels(const char* chart_name, const char* kind) {
        vfit_size_chart chart{};
        EXPECT_EQ(vfit_size_chart_open(context, chart_name, &chart), VFIT_OK) << contract::last_error();
        uint32_t count = 0;
        EXPECT_EQ(vfit_size_chart_rows(chart, nullptr, sizeof(vfit_size_row), &count), VFIT_OK);
        std::vector<vfit_size_row> rows(count, vfit_size_row_init());
        EXPECT_EQ(vfit_size_chart_rows(chart, rows.data(), sizeof(vfit_size_row), &count), VFIT_OK);
        std::set<std::string> out;
        for (const vfit_size_row& row : rows)
            if (std::strcmp(row.garment_kind, kind) == 0) out.insert(row.label);
        EXPECT_EQ(vfit_size_chart_destroy(chart), VFIT_OK);
        return out;
    }
};

}  // namespace

TEST_F(DataTest, ListsWhatOpens) {
    const auto garments = names(vfit_garment_list), charts = names(vfit_size_chart_list);
    for (const auto& list : {garments, charts}) {
        EXPECT_FALSE(list.empty());
        EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
    }
    for (const std::string& name : charts) {
        vfit_size_chart chart{};
        EXPECT_EQ(vfit_size_chart_open(context, name.c_str(), &chart), VFIT_OK) << contract::last_error();
        EXPECT_EQ(vfit_size_chart_destroy(chart), VFIT_OK);
    }
}

TEST_F(DataTest, EveryGarmentNamesAChartWithItsKindAndLabels) {
    for (const std::string& name : names(vfit_garment_list)) {
        vfit_garment garment{};
        ASSERT_EQ(vfit_garment_open(context, name.c_str(), &garment), VFIT_OK) << contract::last_error();
        vfit_garment_info info = vfit_garment_info_init();
        ASSERT_EQ(vfit_garment_describe(garment, &info), VFIT_OK);
        EXPECT_TRUE(info.body_sex == VFIT_SEX_FEMALE || info.body_sex == VFIT_SEX_MALE) << name;
        ASSERT_NE(info.size_chart[0], 0) << name;
        const auto known = labels(info.size_chart, info.garment_kind);
        EXPECT_FALSE(known.empty()) << name << ": " << info.size_chart << " has no " << info.garment_kind;
        for (uint32_t i = 0; i < info.size_count; ++i) {
            char label[32];
            vfit_garment_size_label(garment, i, label, sizeof label);
            EXPECT_TRUE(known.count(label)) << name << " " << label;
        }
        EXPECT_EQ(vfit_garment_destroy(garment), VFIT_OK);
    }
}

TEST_F(DataTest, ListsOfAFolderWithoutDataAreEmpty) {
    vfit_context_desc desc = contract::context_desc();
    desc.data_dir = "/no/such/folder";
    vfit_context bare{};
    ASSERT_EQ(vfit_context_create(&desc, &bare), VFIT_OK) << contract::last_error();
    uint32_t count = 7;
    EXPECT_EQ(vfit_garment_list(bare, nullptr, sizeof(vfit_data_name), &count), VFIT_OK);
    EXPECT_EQ(count, 0u);
    EXPECT_EQ(vfit_size_chart_list(bare, nullptr, sizeof(vfit_data_name), nullptr), VFIT_ERROR_ARGUMENT);
    vfit_data_name few = vfit_data_name_init();
    count = 1;
    EXPECT_EQ(vfit_garment_list(context, &few, sizeof few, &count), VFIT_ERROR_CAPACITY);
    EXPECT_GT(count, 1u);
    EXPECT_EQ(vfit_context_destroy(bare), VFIT_OK);
}

TEST_F(DataTest, AScanTellsTheSexThatItWasToldOrFinds) {
    struct Case {
        const char* shown;
        vfit_sex told;
        vfit_scan_method method;
        vfit_sex expected;
        float least, most;  // probability
    };
    for (const Case& c : {Case{"f", VFIT_SEX_UNKNOWN, VFIT_SCAN_DEFAULT, VFIT_SEX_FEMALE, 0.5f, 1.0f},
                          Case{"m", VFIT_SEX_UNKNOWN, VFIT_SCAN_FIT, VFIT_SEX_MALE, 0.5f, 1.0f},
                          Case{"m", VFIT_SEX_FEMALE, VFIT_SCAN_DEFAULT, VFIT_SEX_FEMALE, 1.0f, 1.0f},
                          Case{"m", VFIT_SEX_UNKNOWN, VFIT_SCAN_PROPORTIONS, VFIT_SEX_UNKNOWN, 0.0f, 0.0f}}) {
        vfit_scan_desc desc = vfit_scan_desc_init();
        desc.sex = c.told;
        desc.method = c.method;
        desc.frame_count = 3;
        vfit_scan scan{};
        ASSERT_EQ(vfit_scan_create(context, &desc, &scan), VFIT_OK) << contract::last_error();
        vfit_sex sex = 7;
        float probability = 7.0f;
        EXPECT_EQ(vfit_scan_sex(scan, &sex, &probability), VFIT_ERROR_STATE);
        EXPECT_EQ(vfit_scan_sex(scan, nullptr, &probability), VFIT_ERROR_ARGUMENT);
        vfit_sensor sensor{};
        const std::string uri =
            std::string("virtual:motion=scan&sensor=kinect_v1_320&seed=3&frames=20&sex=") + c.shown;
        ASSERT_EQ(vfit_sensor_open(context, uri.c_str(), &sensor), VFIT_OK) << contract::last_error();
        ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        vfit_frame frame{};
        while (vfit_sensor_acquire(sensor, -1, &frame) == VFIT_OK) {
            EXPECT_GE(vfit_scan_add(scan, frame, 1, nullptr), 0) << contract::last_error();
            EXPECT_EQ(vfit_frame_release(frame), VFIT_OK);
        }
        ASSERT_EQ(vfit_scan_sex(scan, &sex, &probability), VFIT_OK) << contract::last_error();
        EXPECT_EQ(sex, c.expected);
        EXPECT_GE(probability, c.least);
        EXPECT_LE(probability, c.most);
        EXPECT_EQ(vfit_scan_sex(scan, &sex, nullptr), VFIT_OK);
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
        EXPECT_EQ(vfit_scan_destroy(scan), VFIT_OK);
    }
}
