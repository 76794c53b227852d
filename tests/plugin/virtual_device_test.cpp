// The virtual person as a plug-in: streams, options, time, and libvfit that loads it.
#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "virtual_host.h"

namespace vfit::virtual_person {
namespace {

TEST(VirtualPerson, IsDiscoveredUnderItsScheme) {
    TestHost host;
    EXPECT_STREQ(host.plugin.schemes, "virtual");
    ASSERT_EQ(host.plugin.discover(host.plugin.self), VFIT_OK);
    ASSERT_EQ(host.found.size(), 1u);
    EXPECT_STREQ(host.found[0].uri, "virtual:");
}

TEST(VirtualPerson, RefusesAHostOfAnotherAbi) {
    vfit_host host{};
    host.abi_min = host.abi_max = VFIT_PLUGIN_ABI + 1;
    vfit_plugin plugin{};
    EXPECT_EQ(vfit_plugin_negotiate(&host, &plugin), VFIT_ERROR_VERSION);
}

TEST(VirtualPerson, EndsAfterTheFramesAskedForAndStampsThemAtItsRate) {
    TestHost host;
    const auto frames = host.run("virtual:frames=4&rate=25");
    ASSERT_EQ(frames.size(), 4u);
    EXPECT_EQ(host.state, VFIT_END_OF_STREAM);
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(frames[i].time_ns, 1'000'000'000 + int64_t(i) * 40'000'000);
        EXPECT_EQ(frames[i].meta.at("index"), std::to_string(i));
        EXPECT_EQ(frames[i].width, 640u);
        EXPECT_EQ(frames[i].intrinsics.width, 640u);
    }
}

TEST(VirtualPerson, EqualSeedsGiveEqualBitsAndOthersDiffer) {
    TestHost host;
    const auto a = host.run("virtual:seed=7&frames=3&motion=walk"),
               b = host.run("virtual:seed=7&frames=3&motion=walk"),
               c = host.run("virtual:seed=8&frames=3&motion=walk");
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(a[i].depth, b[i].depth);
        EXPECT_EQ(a[i].user, b[i].user);
        for (size_t j = 0; j < a[i].joints.size(); ++j)
            EXPECT_EQ(0, std::memcmp(a[i].joints[j].position, b[i].joints[j].position, sizeof(float) * 3));
        EXPECT_NE(a[i].depth, c[i].depth);
    }
}

TEST(VirtualPerson, BadOptionsAreRefusedByName) {
    TestHost host;
    const auto refusal = [&](const char* uri) {
        void* device = nullptr;
        EXPECT_EQ(host.open(uri, device), VFIT_ERROR_ARGUMENT) << uri;
        return std::string(host.plugin.last_error(host.plugin.self));
    };
    EXPECT_NE(refusal("virtual:colour=red").find("'colour'"), std::string::npos);
    EXPECT_NE(refusal("virtual:colour=red").find("distance"), std::string::npos);
    EXPECT_NE(refusal("virtual:sensor=lidar").find("azure"), std::string::npos);
    EXPECT_NE(refusal("virtual:weight=9").find("weight"), std::string::npos);
    EXPECT_NE(refusal("virtual:sex=q").find("sex"), std::string::npos);

    void* device = nullptr;
    ASSERT_EQ(host.open("virtual:bvh=/no/such.bvh", device), VFIT_OK);
    EXPECT_EQ(host.plugin.start(device), VFIT_ERROR_IO);
    EXPECT_NE(std::string(host.plugin.last_error(host.plugin.self)).find("/no/such.bvh"), std::string::npos);
    EXPECT_EQ(host.plugin.set_option(device, "bvh", ""), VFIT_OK);
    host.plugin.close(device);
}

TEST(VirtualPerson, ListsModesAndOptions) {
    TestHost host;
    void* device = nullptr;
    ASSERT_EQ(host.open("virtual:weight=0.7", device), VFIT_OK);
    vfit_sensor_mode mode = vfit_sensor_mode_init();
    ASSERT_EQ(host.plugin.mode(device, 1, &mode), VFIT_OK);
    EXPECT_STREQ(mode.name, "kinect_v1_320");
    EXPECT_EQ(mode.width, 320u);
    EXPECT_EQ(host.plugin.mode(device, 99, &mode), VFIT_END_OF_STREAM);
    std::map<std::string, std::string> options;
    vfit_sensor_option option = vfit_sensor_option_init();
    for (uint32_t i = 0; host.plugin.option(device, i, &option) == VFIT_OK; ++i)
        options[option.key] = option.value;
    EXPECT_EQ(options.at("sensor"), "kinect_v1");
    EXPECT_EQ(options.at("weight"), "0.7");
    EXPECT_LT(options.size(), 256u) << "a host reads no more";
    host.plugin.close(device);
}

TEST(VirtualPerson, InRealTimeASlowMachineLosesFramesAndDoesNotFallBehind) {
    TestHost host;
    host.tick_ns = 10'000'000;  // the clock is read twice a frame, so that each takes 20 ms and not 10
    const auto frames = host.run("virtual:sensor=kinect_v1_320&rate=100&frames=40&pace=realtime");
    EXPECT_EQ(host.state, VFIT_END_OF_STREAM);
    ASSERT_GT(frames.size(), 4u);
    EXPECT_LT(frames.size(), 40u);
    for (size_t i = 1; i < frames.size(); ++i) EXPECT_GT(frames[i].time_ns, frames[i - 1].time_ns);
    EXPECT_LT(host.now_ns - frames.back().time_ns, 100'000'000) << "the last frame is of the present";
}

TEST(VirtualPerson, StopsInTheMiddleOfAnEndlessStream) {
    TestHost host;
    host.capacity = 3;
    EXPECT_EQ(host.run("virtual:sensor=kinect_v1_320").size(), 3u);
    EXPECT_EQ(host.state, VFIT_OK) << "a stop is no news";
}

// Meant for the address sanitizer: nothing may be left, and no thread either.
TEST(VirtualPerson, OpensAndClosesFiftyTimes) {
    TestHost host;
    host.capacity = 1;
    for (int i = 0; i < 50; ++i) ASSERT_EQ(host.run("virtual:sensor=kinect_v1_320").size(), 1u);
}

TEST(VirtualPerson, IsASensorOfLibvfit) {
    vfit_context_desc desc = vfit_context_desc_init();
    desc.api_version = VFIT_VERSION;
    desc.plugin_dir = VFIT_PLUGIN_DIR;
    vfit_context context{};
    ASSERT_EQ(vfit_context_create(&desc, &context), VFIT_OK);
    vfit_sensor sensor{};
    EXPECT_EQ(vfit_sensor_open(context, "virtual:frames=5&motion=fly", &sensor), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(sensor.id, 0u);
    ASSERT_EQ(vfit_sensor_open(context, "virtual:?frames=1&seed=%37", &sensor), VFIT_OK);
    uint32_t option_count = 0;
    ASSERT_EQ(vfit_sensor_options(sensor, nullptr, 0, &option_count), VFIT_OK);
    std::vector<vfit_sensor_option> options(option_count, vfit_sensor_option_init());
    ASSERT_EQ(vfit_sensor_options(sensor, options.data(), sizeof options[0], &option_count), VFIT_OK);
    const auto seed = std::find_if(options.begin(), options.end(),
                                   [](const vfit_sensor_option& o) { return std::string(o.key) == "seed"; });
    ASSERT_NE(seed, options.end());
    EXPECT_STREQ(seed->value, "7");
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
    ASSERT_EQ(vfit_sensor_open(context, "virtual:frames=5&sensor=kinect_v1_320", &sensor), VFIT_OK);
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
    vfit_frame frame{};
    for (int i = 0; i < 5; ++i) {
        ASSERT_EQ(vfit_sensor_acquire(sensor, 20'000'000'000, &frame), VFIT_OK);
        uint32_t count = VFIT_JOINT_COUNT;
        std::vector<vfit_joint> joints(count, vfit_joint_init());
        ASSERT_EQ(vfit_frame_joints(frame, 1, joints.data(), sizeof(vfit_joint), &count), VFIT_OK);
        EXPECT_EQ(count, VFIT_JOINT_COUNT);
        for (const vfit_joint& j : joints) {
            EXPECT_GT(j.position[1], 0.0f) << "world space: above the floor";
            EXPECT_NEAR(j.position[2], -2.7f, 0.5f);
        }
        char meta[64];
        uint32_t length = 0;
        ASSERT_EQ(vfit_frame_meta(frame, "index", meta, sizeof meta, &length), VFIT_OK);
        EXPECT_EQ(std::string(meta), std::to_string(i));
        vfit_frame_release(frame);
    }
    EXPECT_EQ(vfit_sensor_acquire(sensor, 20'000'000'000, &frame), VFIT_END_OF_STREAM);
    EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
    EXPECT_EQ(vfit_context_destroy(context), VFIT_OK);
}

}  // namespace
}  // namespace vfit::virtual_person
