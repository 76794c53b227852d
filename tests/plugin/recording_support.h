// Recordings made for a test, and their frames as the plug-in plays them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "core/platform.h"
#include "frame/floor.h"
#include "record/recorder.h"
#include "sensor/plugin_host.h"

namespace vfit::test {

namespace fs = std::filesystem;

inline constexpr uint32_t kWidth = 32, kHeight = 24;

/// Depth of a pixel of a synthetic frame: every bit is in use, and no two frames are alike.
inline uint16_t depth_at(uint32_t frame, uint32_t pixel) {
    return static_cast<uint16_t>((pixel * 2654435761u) >> 16 ^ frame * 40503u);
}

inline Ref<Frame> synthetic_frame(uint32_t number, uint32_t width = kWidth, uint32_t height = kHeight) {
    auto frame = make<Frame>();
    auto* depth =
        static_cast<uint16_t*>(frame->add_stream(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, width, height));
    for (uint32_t i = 0; i < width * height; ++i) depth[i] = depth_at(number, i);
    frame->time_ns = 5'000'000'000 + int64_t(number) * 33'333'333 + (number % 3) * 1'000'000;
    Camera& c = frame->camera;
    c.width = width;
    c.height = height;
    c.fx = c.fy = 28.5f;
    c.cx = 15.5f;
    c.cy = 11.5f;
    set_floor(c, 1.2f, 0.1f, 0.02f, VFIT_FLOOR_GIVEN);
    Body body;
    body.id = 1;
    body.set(VFIT_JOINT_HEAD, {0.01f * float(number), -0.5f, 2.5f}, VFIT_JOINT_MEASURED, 0.5f);
    body.set(VFIT_JOINT_LEFT_FOOT, {0.1f, 1.0f, 2.6f});
    frame->bodies = {to_world(body, c)};
    frame->set_meta("contacts", number % 2 ? R"({"left": 1, "right": 2})" : R"({"left": 0, "right": 1})");
    frame->set_meta("measures", R"({"stature_m":1.75})");
    return frame;
}

/// What one run of a recording gave.
struct Replay {
    std::vector<Ref<Frame>> frames;  // the first few; the rest went by
    size_t count = 0;
    vfit_result end = VFIT_OK;  // of the stream, or of opening it
    std::string message;

    bool failed() const { return end < 0; }
    bool says(const std::string& part) const { return message.find(part) != std::string::npos; }
};

class RecordingTest : public testing::Test {
protected:
    static constexpr size_t kKept = 5;  // fewer than a sensor's pool has

    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() / ("vfit_recording_" + std::string(test->name()));
        fs::remove_all(folder_);
        host_.load(std::string(VFIT_PLUGIN_DIR "/vfit_recording") + library_suffix());
    }
    void TearDown() override {
        host_.shutdown();
        fs::remove_all(folder_);
    }

    void record(uint32_t frames, const RecorderDesc& desc = {}) {
        fs::remove_all(folder_);
        Recorder recorder(folder_.string(), desc);
        for (uint32_t i = 0; i < frames; ++i) recorder.write(*synthetic_frame(i));
    }

    Ref<Sensor> open() { return host_.open("recording:" + folder_.string() + query_); }

    /// Opens and plays to the end, or to `most` frames; `look` sees every frame.
    Replay play(const std::function<void(Sensor&)>& set_up = {},
                const std::function<void(const Frame&)>& look = {}, size_t most = SIZE_MAX) {
        Replay replay;
        Ref<Sensor> sensor;
        try {
            sensor = open();
            if (set_up) set_up(*sensor);
            sensor->start();
            Ref<Frame> frame;
            while (replay.count < most && (replay.end = sensor->acquire(20'000'000'000, frame)) == VFIT_OK) {
                if (look) look(*frame);
                if (replay.frames.size() < kKept) replay.frames.push_back(frame);
                frame = nullptr;
                ++replay.count;
            }
        } catch (const Error& error) {
            replay.end = error.code();
            replay.message = error.what();
        }
        if (sensor) sensor->close();
        return replay;
    }

    std::string read(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void write(const std::string& name, const std::string& bytes) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name, std::ios::binary | std::ios::trunc) << bytes;
    }
    /// Replaces the first occurrence of a text in a file.
    void edit(const std::string& name, const std::string& from, const std::string& to) const {
        std::string text = read(name);
        const size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << name << " has no " << from;
        write(name, text.replace(at, from.size(), to));
    }

    fs::path folder_;
    std::string query_;  // the options of the URI, from the ? on
    Log log_{[](void*, vfit_log_level, const char*) {}, nullptr};
    PluginHost host_{log_, [] { return uint64_t(0); }};
};

inline bool depth_is_synthetic(const Frame& frame, uint32_t number) {
    const Stream& depth = *frame.find(VFIT_STREAM_DEPTH);
    for (uint32_t i = 0; i < depth.items(); ++i)
        if (depth.as<uint16_t>()[i] != depth_at(number, i)) return false;
    return true;
}

}  // namespace vfit::test
