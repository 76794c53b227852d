// The rules of sized structs, lists, texts, flags and enums.
#include <cmath>
#include <cstring>
#include <limits>

#include "contract/support.h"

using contract::ContextTest;

namespace {

/// A caller of a later version: the library's struct with more behind it.
template <typename T>
struct Newer {
    T known;
    uint32_t more[4];
};

}  // namespace

TEST(Contract, VersionAndNamesAreThere) {
    EXPECT_EQ(vfit_version(), uint32_t(VFIT_VERSION));
    for (vfit_result r = VFIT_ERROR_NOT_WEARABLE; r <= VFIT_END_OF_STREAM; ++r)
        EXPECT_STRNE(vfit_result_name(r), "?") << r;
    EXPECT_STREQ(vfit_result_name(99), "?");
    vfit_library_info info = vfit_library_info_init();
    ASSERT_EQ(vfit_library_describe(&info), VFIT_OK);
    EXPECT_GT(std::strlen(info.simd), 0u);
    EXPECT_GT(std::strlen(info.build), 0u);
}

TEST(Contract, AContextNeedsADescriptionOfTheRightVersion) {
    vfit_context context{77};
    EXPECT_EQ(vfit_context_create(nullptr, &context), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(context.id, 0u) << "a failed create must null its handle";
    vfit_context_desc desc = contract::context_desc();
    EXPECT_EQ(vfit_context_create(&desc, nullptr), VFIT_ERROR_ARGUMENT);
    desc.api_version = VFIT_MAKE_VERSION(9, 0, 0);
    EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_ERROR_VERSION);
    desc.api_version = 0;
    EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_ERROR_VERSION);
}

TEST(Contract, WrongFlagsEnumsAndHalfAJobSystemAreRefused) {
    vfit_context context{};
    vfit_context_desc desc = contract::context_desc();
    desc.flags = 0x80;
    EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_ERROR_ARGUMENT);
    desc = contract::context_desc();
    desc.axes = 3;
    EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_ERROR_ARGUMENT);
    desc.axes = -1;
    EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_ERROR_ARGUMENT);
    desc = contract::context_desc();
    desc.wait = [](void*, void*) {};
    EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("together"), std::string::npos);
    desc = contract::context_desc();
    desc.worker_count = 100000;
    EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_ERROR_ARGUMENT);
}

TEST(Contract, AStructWithoutSizeIsRefused) {
    vfit_context context{};
    vfit_context_desc desc = contract::context_desc();
    for (const uint32_t size : {0u, 1u, 4u, 7u, 5000u, 0xFFFFFFFFu}) {
        desc.struct_size = size;
        EXPECT_EQ(vfit_context_create(&desc, &context), VFIT_ERROR_ARGUMENT) << size;
    }
}

TEST_F(ContextTest, AShortStructReadsAsDefaultsBehindItsEnd) {
    vfit_scan_desc desc = vfit_scan_desc_init();
    desc.struct_size = 8;           // the caller knows `method` alone
    desc.frame_count = 0xFFFFFFFF;  // beyond its struct: must not be read
    desc.sex = 99;
    vfit_scan scan{};
    EXPECT_EQ(vfit_scan_create(context, &desc, &scan), VFIT_OK) << contract::last_error();
}

TEST_F(ContextTest, ALongStructIsTakenWhileItsUnknownTailIsZero) {
    Newer<vfit_scan_desc> desc{};
    desc.known.struct_size = sizeof desc;
    vfit_scan scan{};
    EXPECT_EQ(vfit_scan_create(context, &desc.known, &scan), VFIT_OK) << contract::last_error();
    desc.more[2] = 1;
    EXPECT_EQ(vfit_scan_create(context, &desc.known, &scan), VFIT_ERROR_UNSUPPORTED);
    EXPECT_EQ(scan.id, 0u);
}

TEST_F(ContextTest, OfAnOutputStructOnlyItsSizeIsWritten) {
    vfit_context_stats stats;
    std::memset(&stats, 0xAB, sizeof stats);
    stats.struct_size = 8;
    ASSERT_EQ(vfit_context_describe(context, &stats), VFIT_OK);
    EXPECT_EQ(stats.struct_size, 8u);
    EXPECT_EQ(stats.handle_count, 0u);
    EXPECT_EQ(stats.frame_count, 0xABABABABu);
    EXPECT_EQ(vfit_context_describe(context, nullptr), VFIT_ERROR_ARGUMENT);
    stats.struct_size = 0;
    EXPECT_EQ(vfit_context_describe(context, &stats), VFIT_ERROR_ARGUMENT);
}

TEST_F(ContextTest, ListsTellTheirLengthFillAndRefuseAShortArray) {
    uint32_t count = 0;
    ASSERT_EQ(vfit_profile_list(context, nullptr, 0, &count), VFIT_OK);
    ASSERT_GT(count, 1u);
    std::vector<vfit_profile> items(count);
    uint32_t less = count - 1;
    EXPECT_EQ(vfit_profile_list(context, items.data(), sizeof(vfit_profile), &less), VFIT_ERROR_CAPACITY);
    EXPECT_EQ(less, count);
    uint32_t more = count + 5;
    items.resize(more);
    EXPECT_EQ(vfit_profile_list(context, items.data(), sizeof(vfit_profile), &more), VFIT_OK);
    EXPECT_EQ(more, count);
    EXPECT_GT(std::strlen(items[0].stage), 0u);
    EXPECT_EQ(vfit_profile_list(context, items.data(), 3, &more), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_profile_list(context, items.data(), sizeof(vfit_profile), nullptr), VFIT_ERROR_ARGUMENT);
}

TEST_F(ContextTest, ListsHonourAStrideLargerThanTheStructAndZeroItsTail) {
    uint32_t count = 0;
    ASSERT_EQ(vfit_profile_list(context, nullptr, 0, &count), VFIT_OK);
    std::vector<Newer<vfit_profile>> items(count);
    std::memset(static_cast<void*>(items.data()), 0xCD, items.size() * sizeof items[0]);
    ASSERT_EQ(vfit_profile_list(context, &items[0].known, sizeof items[0], &count), VFIT_OK);
    for (const auto& item : items)
        for (const uint32_t word : item.more) EXPECT_EQ(word, 0u);
    EXPECT_GT(std::strlen(items[1].known.stage), 0u);
}

TEST(Contract, TextsAreCutAndAlwaysEnded) {
    char small[5];
    std::memset(small, 'x', sizeof small);
    EXPECT_EQ(vfit_joint_name(VFIT_JOINT_LEFT_SHOULDER, small, sizeof small), 13u);
    EXPECT_STREQ(small, "LEFT");
    EXPECT_EQ(vfit_joint_name(VFIT_JOINT_HEAD, nullptr, 0), 4u);
    EXPECT_EQ(vfit_joint_name(1000, small, sizeof small), 0u);
    EXPECT_STREQ(small, "");
    EXPECT_EQ(vfit_joint_name(-1, small, 0), 0u);
    char name[32];
    EXPECT_GT(vfit_bone_name(VFIT_BONE_LEFT_UPPER_ARM, name, sizeof name), 0u);
    EXPECT_STREQ(name, "leftUpperArm");
    EXPECT_EQ(vfit_bone_parent(VFIT_BONE_HIPS), -1);
    EXPECT_EQ(vfit_bone_parent(VFIT_BONE_LEFT_LOWER_ARM), VFIT_BONE_LEFT_UPPER_ARM);
    EXPECT_EQ(vfit_bone_parent(500), -2);
}

TEST(Contract, EveryMeasureHasAKeyAndADefinition) {
    char key[64], text[512];
    uint32_t n = 0;
    bool stature = false;
    while (vfit_measure_key(n, key, sizeof key) > 0) {
        EXPECT_GT(vfit_measure_text(n, text, sizeof text), 10u) << key;
        EXPECT_TRUE(std::string(key).ends_with("_m") || std::string(key).ends_with("_kg")) << key;
        stature = stature || std::string(key) == "stature_m";
        ++n;
    }
    EXPECT_GT(n, 12u);
    EXPECT_TRUE(stature);
}

TEST_F(ContextTest, LogLinesCanBePolled) {
    vfit_log_level level;
    char line[256];
    while (vfit_log_next(context, &level, line, sizeof line) == VFIT_OK) EXPECT_GT(std::strlen(line), 0u);
    EXPECT_EQ(vfit_log_next(context, &level, nullptr, 0), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_log_next(context, nullptr, line, sizeof line), VFIT_ERROR_ARGUMENT);
}

TEST_F(ContextTest, PluginsThatCannotBeLoadedNameTheCause) {
    EXPECT_EQ(vfit_plugin_load(context, "/no/such/plugin.so"), VFIT_ERROR_PLUGIN);
    EXPECT_NE(contract::last_error().find("plugin.so"), std::string::npos);
    EXPECT_EQ(vfit_plugin_load(context, nullptr), VFIT_ERROR_ARGUMENT);
}

TEST_F(ContextTest, WrongScanAndMotionSettingsAreRefused) {
    vfit_scan scan{};
    vfit_scan_desc desc = vfit_scan_desc_init();
    desc.method = 17;
    EXPECT_EQ(vfit_scan_create(context, &desc, &scan), VFIT_ERROR_ARGUMENT);
    desc = vfit_scan_desc_init();
    desc.sex = 3;
    EXPECT_EQ(vfit_scan_create(context, &desc, &scan), VFIT_ERROR_ARGUMENT);
    desc = vfit_scan_desc_init();
    desc.frame_count = 1000000;
    EXPECT_EQ(vfit_scan_create(context, &desc, &scan), VFIT_ERROR_ARGUMENT);
    vfit_motion motion{};
    vfit_motion_desc motion_desc = vfit_motion_desc_init();
    motion_desc.flags = 1u << 30;
    EXPECT_EQ(vfit_motion_create(context, &motion_desc, &motion), VFIT_ERROR_ARGUMENT);
    motion_desc = vfit_motion_desc_init();
    motion_desc.smoothing = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(vfit_motion_create(context, &motion_desc, &motion), VFIT_ERROR_ARGUMENT);
    motion_desc.smoothing = 1.5f;
    EXPECT_EQ(vfit_motion_create(context, &motion_desc, &motion), VFIT_ERROR_ARGUMENT);
    motion_desc = vfit_motion_desc_init();
    motion_desc.range_of_motion = R"({"knee": {"flexion": 60}})";
    EXPECT_EQ(vfit_motion_create(context, &motion_desc, &motion), VFIT_OK) << contract::last_error();
    motion_desc.range_of_motion = R"({"knee": {"flexion": 600}})";
    EXPECT_EQ(vfit_motion_create(context, &motion_desc, &motion), VFIT_ERROR_DATA);
    EXPECT_NE(contract::last_error().find("knee.flexion"), std::string::npos);
}
