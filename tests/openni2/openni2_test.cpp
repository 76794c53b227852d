// The openni2 plug-in with the real OpenNI2 library: a driver of ours as a device, files of OpenNI2's own
// recorder, and files that somebody has damaged. Each test has its own process of the reader.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <random>
#include <thread>

#include <signal.h>

#include "contract/support.h"
#include "openni2/left_open.h"

namespace {

namespace fs = std::filesystem;
using contract::last_error;
using Clock = std::chrono::steady_clock;

constexpr char kPerson[] = "virtual:sensor=kinect_v1_320&motion=demo&seed=7";
constexpr int kFrames = 40;  // of a recording, at least: the recorder may miss the first or the last

struct Image {
    std::vector<uint16_t> depth;
    std::vector<uint8_t> color;
    vfit_intrinsics intrinsics = vfit_intrinsics_init();
    int64_t time_ns = 0;
};

std::vector<uint8_t> bytes_of(const vfit_view& view, size_t item) {
    std::vector<uint8_t> out(size_t(view.width) * view.height * item);
    for (uint32_t y = 0; y < view.height; ++y)
        std::memcpy(out.data() + y * size_t(view.width) * item,
                    static_cast<const char*>(view.data) + size_t(y) * view.row_stride,
                    size_t(view.width) * item);
    return out;
}

Image image_of(vfit_frame frame) {
    Image image;
    vfit_view view = vfit_view_init();
    EXPECT_EQ(vfit_frame_view(frame, VFIT_STREAM_DEPTH, &view), VFIT_OK) << last_error();
    const auto depth = bytes_of(view, 2);
    image.depth.resize(depth.size() / 2);
    std::memcpy(image.depth.data(), depth.data(), depth.size());
    image.time_ns = view.time_ns;
    if (vfit_frame_view(frame, VFIT_STREAM_COLOR, &view) == VFIT_OK) image.color = bytes_of(view, 4);
    EXPECT_EQ(vfit_frame_intrinsics(frame, &image.intrinsics), VFIT_OK);
    return image;
}

int index_of(vfit_frame frame) {
    char text[32];
    uint32_t length = 0;
    return vfit_frame_meta(frame, "index", text, sizeof text, &length) == VFIT_OK ? std::atoi(text) : -1;
}

/// The driver's colour: of its depth.
bool is_color_of(const std::vector<uint8_t>& color, const std::vector<uint16_t>& depth, uint32_t width) {
    if (color.size() != 4 * depth.size()) return false;
    for (size_t i = 0; i < depth.size(); ++i) {
        const uint8_t expected[] = {uint8_t(depth[i] >> 4), uint8_t(depth[i]), uint8_t(i % width), 255};
        if (std::memcmp(&color[4 * i], expected, 4) != 0) return false;
    }
    return true;
}

std::vector<uint8_t> contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

class OpenNi2Test : public contract::ContextTest {
protected:
    static void SetUpTestSuite() {
        folder_ = fs::temp_directory_path() / ("vfit_openni2_" + std::to_string(::getpid()));
        fs::create_directories(folder_);
        ::setenv("VFIT_OPENNI2_LIBRARY", (fs::path(VFIT_OPENNI2_FOLDER) / "libOpenNI2.so.0").c_str(), 1);
        ::setenv("VFIT_TEST_PERSON", kPerson, 1);
        ASSERT_EQ(record("all.oni", std::to_string(kFrames + 5)), 0);
    }
    static void TearDownTestSuite() { fs::remove_all(folder_); }
    void TearDown() override {
        ContextTest::TearDown();
        ::unsetenv("VFIT_TEST_DRIVER"), ::unsetenv("VFIT_TEST_PLUG");
    }
    /// By OpenNI2's recorder. Its own leaks are not ours to judge.
    static int record(const std::string& name, const std::string& words) {
        const std::string folder = VFIT_OPENNI2_FOLDER;
        return std::system(("cd '" + folder_.string() + "' && ASAN_OPTIONS=detect_leaks=0 LD_LIBRARY_PATH='" +
                            folder + "' '" + folder + "/openni2_record' " + name + " " + words)
                               .c_str());
    }
    static fs::path path(const std::string& name) { return folder_ / name; }
    static fs::path write(const std::string& name, const std::vector<uint8_t>& bytes) {
        std::ofstream(path(name), std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        return path(name);
    }
    vfit_sensor open(const std::string& uri) {
        vfit_sensor sensor{};
        EXPECT_EQ(vfit_sensor_open(context, uri.c_str(), &sensor), VFIT_OK) << last_error();
        return sensor;
    }
    void refused(const std::string& uri, vfit_result code, const std::string& says) {
        vfit_sensor sensor{};
        EXPECT_EQ(vfit_sensor_open(context, uri.c_str(), &sensor), code) << uri;
        EXPECT_NE(last_error().find(says), std::string::npos) << last_error();
        EXPECT_EQ(sensor.id, 0u);
    }
    /// Each image by its index, until the stream ends or `most` have come.
    std::map<int, Image> play(vfit_sensor sensor, vfit_result* end = nullptr, size_t most = SIZE_MAX) {
        std::map<int, Image> out;
        EXPECT_EQ(vfit_sensor_start(sensor), VFIT_OK) << last_error();
        vfit_result result = VFIT_OK;
        while (out.size() < most) {
            vfit_frame frame{};
            result = vfit_sensor_acquire(sensor, 20'000'000'000, &frame);
            if (result != VFIT_OK) break;
            out[index_of(frame)] = image_of(frame);
            vfit_frame_release(frame);
        }
        if (end) *end = result;
        EXPECT_EQ(vfit_sensor_stop(sensor), VFIT_OK) << last_error();
        return out;
    }
    std::map<int, Image> truth() {
        const vfit_sensor sensor = open(kPerson);
        return play(sensor, nullptr, kFrames + 30);
    }
    vfit_result state(vfit_sensor sensor) {
        vfit_sensor_stats stats = vfit_sensor_stats_init();
        EXPECT_EQ(vfit_sensor_describe(sensor, &stats), VFIT_OK);
        return stats.state;
    }
    bool comes_to(vfit_sensor sensor, vfit_result wanted, int seconds = 20) {
        const auto until = Clock::now() + std::chrono::seconds(seconds);
        while (Clock::now() < until) {
            if (state(sensor) == wanted) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        return false;
    }
    static fs::path folder_;
};
fs::path OpenNi2Test::folder_;

TEST_F(OpenNi2Test, ADeviceIsListedAndGivesWhatItsDriverSees) {
    vfit_sensor_info list[8];
    for (vfit_sensor_info& item : list) item = vfit_sensor_info_init();
    uint32_t count = 8;
    ASSERT_EQ(vfit_sensor_list(context, list, sizeof list[0], &count), VFIT_OK) << last_error();
    const bool listed = std::any_of(list, list + count, [](const vfit_sensor_info& item) {
        return std::string(item.uri) == "openni2:virtual-person" &&
               std::string(item.name) == "Virtual person behind OpenNI2" &&
               std::string(item.plugin) == "openni2";
    });
    EXPECT_TRUE(listed);

    const auto seen = truth();
    const vfit_sensor sensor = open("openni2:virtual-person");
    const auto images = play(sensor, nullptr, 20);
    ASSERT_EQ(images.size(), 20u);
    for (const auto& [index, image] : images) {
        ASSERT_TRUE(seen.count(index)) << index;
        EXPECT_EQ(image.depth, seen.at(index).depth) << index;
        const vfit_intrinsics &got = image.intrinsics, &want = seen.at(index).intrinsics;
        EXPECT_NEAR(got.fx, want.fx, 1e-3f * want.fx);
        EXPECT_NEAR(got.fy, want.fy, 1e-3f * want.fy);
        EXPECT_EQ(got.cx, 0.5f * float(got.width));  // OpenNI2 knows of no other
    }
}

TEST_F(OpenNi2Test, ColourComesWhereDepthIsRegisteredToIt) {
    const vfit_sensor sensor = open("openni2:");
    for (const bool registered : {true, false}) {
        ASSERT_EQ(vfit_sensor_set_option(sensor, "registration", registered ? "1" : "0"), VFIT_OK)
            << last_error();
        const auto images = play(sensor, nullptr, 12);
        size_t with_color = 0;
        for (const auto& [index, image] : images) with_color += !image.color.empty();
        if (registered)
            EXPECT_GT(with_color, 6u);
        else
            EXPECT_EQ(with_color, 0u);
    }
    ASSERT_EQ(vfit_sensor_set_option(sensor, "registration", "1"), VFIT_OK);
    ASSERT_EQ(vfit_sensor_set_option(sensor, "color", "0"), VFIT_OK);
    for (const auto& [index, image] : play(sensor, nullptr, 6)) EXPECT_TRUE(image.color.empty());
    EXPECT_EQ(vfit_sensor_set_option(sensor, "registration", "2"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_sensor_set_option(sensor, "mode", "1x1@1"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(vfit_sensor_set_option(sensor, "exposure", "1"), VFIT_ERROR_UNSUPPORTED);
    EXPECT_NE(last_error().find("registration"), std::string::npos) << last_error();
    EXPECT_EQ(vfit_sensor_set_option(sensor, "start", "1"), VFIT_ERROR_UNSUPPORTED);  // of a file
}

TEST_F(OpenNi2Test, WhatItsRecorderWroteComesBackBitForBit) {
    const auto seen = truth();
    const vfit_sensor sensor = open(path("all.oni").string());
    uint32_t count = 0;
    ASSERT_EQ(vfit_sensor_modes(sensor, nullptr, 0, &count), VFIT_OK);
    EXPECT_EQ(count, 1u);
    ASSERT_EQ(vfit_sensor_set_option(sensor, "color", "1"), VFIT_OK) << last_error();
    vfit_result end = VFIT_OK;
    const auto images = play(sensor, &end);
    EXPECT_EQ(end, VFIT_END_OF_STREAM) << last_error();
    ASSERT_GE(images.size(), size_t(kFrames));
    // The recorder begins with the image in which it was started.
    const int shift = [&] {
        for (int k = 0; k < 30; ++k)
            if (seen.at(k).depth == images.begin()->second.depth) return k;
        return -1;
    }();
    ASSERT_GE(shift, 0);
    int equal = 0, colored = 0;
    int64_t before_ns = 0;
    for (const auto& [index, image] : images) {
        if (!seen.count(index + shift)) break;
        equal += image.depth == seen.at(index + shift).depth;
        colored += is_color_of(image.color, image.depth, image.intrinsics.width);
        EXPECT_GT(image.time_ns, before_ns);
        before_ns = image.time_ns;
    }
    EXPECT_GE(equal, kFrames);
    EXPECT_GE(colored, kFrames - 2) << "colour of the same moment";
    RecordProperty("frames", int(images.size()));
}

TEST_F(OpenNi2Test, AFilePlaysAPartAndAgainAndAgain) {
    const vfit_sensor sensor = open("oni:" + path("all.oni").string());
    const auto all = play(sensor);
    ASSERT_EQ(vfit_sensor_set_option(sensor, "start", "10"), VFIT_OK) << last_error();
    ASSERT_EQ(vfit_sensor_set_option(sensor, "count", "5"), VFIT_OK) << last_error();
    const auto part = play(sensor);
    ASSERT_EQ(part.size(), 5u);
    for (const auto& [index, image] : part) EXPECT_EQ(image.depth, all.at(index).depth);
    EXPECT_EQ(part.begin()->first, 10);
    for (int round = 0; round < 2; ++round) {  // stopped in the middle, it begins anew
        const auto begun = play(sensor, nullptr, 2);
        ASSERT_EQ(begun.size(), 2u);
        EXPECT_EQ(begun.begin()->first, 10);
        EXPECT_EQ(begun.begin()->second.depth, all.at(10).depth);
    }
    ASSERT_EQ(vfit_sensor_set_option(sensor, "loop", "1"), VFIT_OK);
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK) << last_error();
    for (int i = 0; i < 12; ++i) {
        vfit_frame frame{};
        ASSERT_EQ(vfit_sensor_acquire(sensor, 20'000'000'000, &frame), VFIT_OK) << last_error();
        EXPECT_EQ(index_of(frame), 10 + i % 5);
        vfit_frame_release(frame);
    }
    EXPECT_EQ(vfit_sensor_set_option(sensor, "start", "1"), VFIT_ERROR_STATE);
    EXPECT_EQ(vfit_sensor_stop(sensor), VFIT_OK);
    EXPECT_EQ(vfit_sensor_set_option(sensor, "start", "100000"), VFIT_ERROR_ARGUMENT);
}

TEST_F(OpenNi2Test, AFileTakesOptionsInItsUri) {
    const std::string file = path("all.oni").string();
    for (const std::string& source : {file, "oni:" + file, "openni2:" + file}) {
        const vfit_sensor sensor = open(source + "?start=10&count=5&color=1");
        vfit_result end = VFIT_OK;
        const auto part = play(sensor, &end);
        EXPECT_EQ(end, VFIT_END_OF_STREAM) << last_error();
        ASSERT_EQ(part.size(), 5u) << source;
        EXPECT_EQ(part.begin()->first, 10);
        EXPECT_EQ(part.rbegin()->first, 14);
        EXPECT_FALSE(part.rbegin()->second.color.empty());
    }
    const vfit_sensor loop = open("openni2:" + file + "?loop=1&start=10&count=4");
    ASSERT_EQ(vfit_sensor_start(loop), VFIT_OK) << last_error();
    int64_t last_ns = 0;
    for (int i = 0; i < 10; ++i) {
        vfit_frame frame{};
        ASSERT_EQ(vfit_sensor_acquire(loop, 20'000'000'000, &frame), VFIT_OK) << last_error();
        EXPECT_EQ(index_of(frame), 10 + i % 4);
        const int64_t time_ns = image_of(frame).time_ns;
        EXPECT_GT(time_ns, last_ns);
        last_ns = time_ns;
        vfit_frame_release(frame);
    }
    for (const char* value : {"-1", "abc", "100000", ""})
        refused(file + "?start=" + value, VFIT_ERROR_ARGUMENT,
                "option start: '" + std::string(value) + "' is not a whole number in 0..");
    refused("oni:" + file + "?exposure=1", VFIT_ERROR_UNSUPPORTED, "loop, start, count");
    refused("openni2:" + file + "?start=1&start=2", VFIT_ERROR_ARGUMENT, "option start: is given twice");
    refused("openni2:" + file + "?=2", VFIT_ERROR_ARGUMENT, "has no key");
    refused("oni:" + file + "?mode=1x1@1", VFIT_ERROR_ARGUMENT, "'1x1@1'");
}

TEST_F(OpenNi2Test, ADeviceTakesOptionsInItsUri) {
    for (const auto& [index, image] : play(open("openni2:virtual-person?color=0"), nullptr, 6))
        EXPECT_TRUE(image.color.empty());
    EXPECT_EQ(play(open("openni2:?pace=none"), nullptr, 3).size(), 3u);
    refused("openni2:virtual-person?start=1", VFIT_ERROR_UNSUPPORTED, "'start'");
    refused("openni2:?registration=2", VFIT_ERROR_ARGUMENT, "'2'");
}

TEST_F(OpenNi2Test, InRealTimeAFileLastsAsLongAsItsRecording) {
    const vfit_sensor sensor = open(path("all.oni").string());
    ASSERT_EQ(vfit_sensor_set_option(sensor, "pace", "realtime"), VFIT_OK) << last_error();
    ASSERT_EQ(vfit_sensor_set_option(sensor, "count", "30"), VFIT_OK) << last_error();
    const auto begin = Clock::now();
    const auto images = play(sensor);
    EXPECT_GT(std::chrono::duration<double>(Clock::now() - begin).count(), 0.9);
    EXPECT_GT(images.size(), 5u);
}

TEST_F(OpenNi2Test, WhatIsNoRecordingIsRefusedByName) {
    refused("oni:" + path("none.oni").string(), VFIT_ERROR_IO, "no such file");
    refused("oni:" + folder_.string(), VFIT_ERROR_IO, "no such file");
    refused(write("empty.oni", {}).string(), VFIT_ERROR_DATA, "empty.oni");
    refused(write("garbage.oni", std::vector<uint8_t>(5000, 0x5a)).string(), VFIT_ERROR_DATA, "garbage.oni");
    ASSERT_EQ(record("color.oni", "5 color"), 0);
    refused(path("color.oni").string(), VFIT_ERROR_UNSUPPORTED, "has no depth stream");
    ASSERT_EQ(record("zero.oni", "0"), 0);
    vfit_sensor sensor{};
    if (vfit_sensor_open(context, path("zero.oni").c_str(), &sensor) == VFIT_OK) {
        vfit_result end = VFIT_OK;
        EXPECT_TRUE(play(sensor, &end).empty());
        EXPECT_EQ(end, VFIT_ERROR_DATA);
    }
    EXPECT_NE(last_error().find("no depth frame"), std::string::npos) << last_error();
    refused("openni2:no-such-device", VFIT_ERROR_IO, "no-such-device");
}

TEST_F(OpenNi2Test, ADriverThatLacksSomethingIsToldByName) {
    ::setenv("VFIT_TEST_DRIVER", "no_depth", 1);
    refused("openni2:", VFIT_ERROR_UNSUPPORTED, "has no depth stream");
    ::setenv("VFIT_TEST_DRIVER", "no_fov", 1);
    vfit_result end = VFIT_OK;
    EXPECT_TRUE(play(open("openni2:"), &end).empty());
    EXPECT_EQ(end, VFIT_ERROR_UNSUPPORTED);
    EXPECT_NE(last_error().find("field of view"), std::string::npos) << last_error();
}

TEST_F(OpenNi2Test, WithoutTheLibraryThePluginSaysSoAndTheRestWorks) {
    const std::string library = std::getenv("VFIT_OPENNI2_LIBRARY");
    ::setenv("VFIT_OPENNI2_LIBRARY", "/nowhere/libOpenNI2.so.0", 1);
    refused("openni2:", VFIT_ERROR_PLUGIN, "libopenni2-0");
    uint32_t count = 0;
    EXPECT_EQ(vfit_sensor_list(context, nullptr, 0, &count), VFIT_OK) << last_error();
    EXPECT_EQ(count, 1u);  // the virtual person
    EXPECT_EQ(play(open(kPerson), nullptr, 2).size(), 2u);
    ::setenv("VFIT_OPENNI2_LIBRARY", library.c_str(), 1);
}

TEST_F(OpenNi2Test, TwoHundredDamagedFilesTakeNobodyDown) {
    const std::vector<uint8_t> whole = contents(path("all.oni"));
    ASSERT_GT(whole.size(), 1000u);
    std::mt19937 random(5);
    const auto below = [&](size_t n) { return std::uniform_int_distribution<size_t>(0, n - 1)(random); };
    int refused = 0, ended = 0, broke = 0, crashed = 0;
    for (int i = 0; i < 200; ++i) {
        std::vector<uint8_t> bytes = whole;
        if (i % 4 == 0)
            bytes.resize(below(bytes.size()));  // cut
        else if (i % 4 == 1)
            for (int k = 0; k < 8; ++k) bytes[below(600)] = uint8_t(below(256));  // its head
        else if (i % 4 == 2)
            for (int k = 0; k < 8; ++k)
                bytes[bytes.size() - 1 - below(6000)] ^= uint8_t(1 + below(255));  // its index
        else
            for (int k = 0; k < 200; ++k) bytes[below(bytes.size())] ^= uint8_t(1 + below(255));  // anywhere
        const fs::path file = write("damaged.oni", bytes);
        vfit_sensor sensor{};
        const vfit_result result = vfit_sensor_open(context, file.c_str(), &sensor);
        if (result != VFIT_OK) {
            EXPECT_TRUE(result == VFIT_ERROR_DATA || result == VFIT_ERROR_UNSUPPORTED)
                << i << ": " << result << " " << last_error();
            EXPECT_NE(last_error().find("damaged.oni"), std::string::npos) << last_error();
            crashed += last_error().find("crashed") != std::string::npos;
            ++refused;
            continue;
        }
        vfit_sensor_set_option(sensor, "count", "12");
        vfit_result end = VFIT_OK;
        play(sensor, &end);
        EXPECT_TRUE(end == VFIT_END_OF_STREAM || end == VFIT_ERROR_DATA || end == VFIT_ERROR_UNSUPPORTED)
            << i << ": " << end << " " << last_error();
        crashed += end != VFIT_END_OF_STREAM && last_error().find("crashed") != std::string::npos;
        (end == VFIT_END_OF_STREAM ? ended : broke) += 1;
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
    }
    std::cout << "200 damaged files: " << refused << " refused, " << broke << " broke while they played, "
              << ended << " played to their end; " << crashed << " crashed the reader\n";
    EXPECT_GT(refused, 20);
}

TEST_F(OpenNi2Test, ADriverThatCrashesIsLostAndComesBack) {
    ::setenv("VFIT_TEST_DRIVER", "crash", 1);
    const vfit_sensor sensor = open("openni2:");
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
    for (int round = 0; round < 2; ++round) {
        ASSERT_TRUE(comes_to(sensor, VFIT_ERROR_DEVICE_LOST)) << round;
        ASSERT_TRUE(comes_to(sensor, VFIT_OK)) << round;
        vfit_frame frame{};
        ASSERT_EQ(vfit_sensor_acquire(sensor, 20'000'000'000, &frame), VFIT_OK) << last_error();
        vfit_frame_release(frame);
    }
    EXPECT_EQ(vfit_sensor_stop(sensor), VFIT_OK);
}

TEST_F(OpenNi2Test, ADriverThatFallsSilentOrHangsIsLost) {
    for (const char* what : {"silent", "hang"}) {
        ::setenv("VFIT_TEST_DRIVER", what, 1);
        const vfit_sensor sensor = open("openni2:");
        ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        EXPECT_TRUE(comes_to(sensor, VFIT_ERROR_DEVICE_LOST)) << what;
        const auto begin = Clock::now();
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);
        EXPECT_LT(std::chrono::duration<double>(Clock::now() - begin).count(), 6.0) << what;
    }
}

TEST_F(OpenNi2Test, ADeviceThatIsUnpluggedComesBackWhenItIsPluggedInAgain) {
    const fs::path plug = path("plug");
    write("plug", {1});
    ::setenv("VFIT_TEST_PLUG", plug.c_str(), 1);
    const vfit_sensor sensor = open("openni2:virtual-person");
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK);
    for (int round = 0; round < 3; ++round) {
        vfit_frame frame{};
        ASSERT_EQ(vfit_sensor_acquire(sensor, 20'000'000'000, &frame), VFIT_OK) << last_error();
        vfit_frame_release(frame);
        fs::remove(plug);
        ASSERT_TRUE(comes_to(sensor, VFIT_ERROR_DEVICE_LOST)) << round;
        std::this_thread::sleep_for(std::chrono::milliseconds(800));  // it looks for it meanwhile
        EXPECT_EQ(state(sensor), VFIT_ERROR_DEVICE_LOST);
        write("plug", {1});
        ASSERT_TRUE(comes_to(sensor, VFIT_OK)) << round;
    }
    // Unplugged while nobody looks.
    ASSERT_EQ(vfit_sensor_stop(sensor), VFIT_OK);
    fs::remove(plug);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    ASSERT_EQ(vfit_sensor_start(sensor), VFIT_OK) << last_error();
    ASSERT_TRUE(comes_to(sensor, VFIT_ERROR_DEVICE_LOST));
    write("plug", {1});
    EXPECT_TRUE(comes_to(sensor, VFIT_OK));
}

TEST_F(OpenNi2Test, NothingIsLeftOpen) {
    const auto round = [&] {
        const vfit_sensor sensor = open(path("all.oni").string());
        EXPECT_EQ(vfit_sensor_start(sensor), VFIT_OK);
        vfit_frame frame{};
        EXPECT_EQ(vfit_sensor_acquire(sensor, 20'000'000'000, &frame), VFIT_OK);
        vfit_frame_release(frame);
        EXPECT_EQ(vfit_sensor_close(sensor), VFIT_OK);  // in the middle of it
        vfit_sensor none{};
        EXPECT_LT(vfit_sensor_open(context, "oni:/nowhere", &none), 0);
    };
    round();
    const size_t before = left_open();
    for (int i = 0; i < 25; ++i) round();
    EXPECT_EQ(left_open(), before);
}

}  // namespace
