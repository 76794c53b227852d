// The real recordings of the shared folder: each is read to its end, and survives being recorded again.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <utility>

#include "core/clock.h"
#include "recording_support.h"

namespace vfit::test {
namespace {

class RecordingReal : public RecordingTest {
protected:
    void SetUp() override {
        RecordingTest::SetUp();
        const char* given = std::getenv("VFIT_SHARED");
        const fs::path shared = given ? fs::path(given) : fs::path(VFIT_SOURCE_DIR) / "../shared";
        std::error_code ignored;
        for (fs::directory_iterator it(shared / "data/recordings", ignored), end; !ignored && it != end; ++it)
            if (it->is_directory()) recordings_.push_back(it->path());
        std::sort(recordings_.begin(), recordings_.end());
        if (recordings_.empty()) GTEST_SKIP() << "no recordings in " << shared;
    }

    Replay play_at(const fs::path& path, const std::function<void(const Frame&)>& look) {
        const fs::path own = std::exchange(folder_, path);
        Replay replay = play({}, look);
        folder_ = own;
        return replay;
    }

    std::vector<fs::path> recordings_;
};

size_t depth_files(const fs::path& recording) {
    return static_cast<size_t>(
        std::distance(fs::directory_iterator(recording / "depth"), fs::directory_iterator()));
}

TEST_F(RecordingReal, EveryFrameOfEveryRecordingIsRead) {
    size_t frames = 0;
    const Stopwatch watch;
    for (const fs::path& recording : recordings_) {
        const Replay replay = play_at(recording, [&](const Frame& frame) {
            const Camera& c = frame.camera;
            EXPECT_EQ(c.width, 320u);
            EXPECT_EQ(c.height, 240u);
            EXPECT_FLOAT_EQ(c.fx, 285.63f);
            EXPECT_FLOAT_EQ(c.cx, 159.0f);
            EXPECT_FLOAT_EQ(c.depth_unit_m, 0.001f);
            EXPECT_EQ(c.floor_state, VFIT_FLOOR_ESTIMATED);
            ASSERT_EQ(frame.bodies.size(), 1u);
            int seen = 0;
            for (int joint = 0; joint < kJointCount; ++joint) {
                if (!frame.bodies[0].has(joint)) continue;
                ++seen;
                const Vec3 p = frame.bodies[0].at(joint);
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
                EXPECT_LT(p.z, 0.0f);  // in front of the camera
                EXPECT_LT(glm::length(p), 6.0f);
            }
            EXPECT_EQ(seen, 20);
            const auto* depth = frame.find(VFIT_STREAM_DEPTH)->as<uint16_t>();
            const auto* users = frame.find(VFIT_STREAM_USER_MAP)->as<uint8_t>();
            size_t person = 0;
            for (size_t i = 0; i < 320 * 240; ++i) {
                ASSERT_EQ(users[i], depth[i] > 0 ? 1 : 0);
                person += users[i];
            }
            EXPECT_GT(person, 1000u);
        });
        EXPECT_EQ(replay.end, VFIT_END_OF_STREAM) << replay.message;
        EXPECT_EQ(replay.count, depth_files(recording)) << recording;
        frames += replay.count;
    }
    std::cout << recordings_.size() << " recordings, " << frames << " frames, " << watch.ms() / double(frames)
              << " ms a frame with all checks\n";
}

TEST_F(RecordingReal, RecordedAgainTheyAreTheSame) {
    const fs::path original = recordings_.front();
    struct Copy {
        std::vector<uint16_t> depth;
        std::vector<uint8_t> users;
        Body body;
        Camera camera;
        int64_t time_ns;
    };
    const auto copy = [](const Frame& frame) {
        const auto* depth = frame.find(VFIT_STREAM_DEPTH)->as<uint16_t>();
        const auto* users = frame.find(VFIT_STREAM_USER_MAP)->as<uint8_t>();
        return Copy{{depth, depth + 320 * 240},
                    {users, users + 320 * 240},
                    frame.bodies.at(0),
                    frame.camera,
                    frame.time_ns};
    };
    std::vector<Copy> first;
    {
        Recorder recorder(folder_.string(), {"kinect_v1", 30.0f, true});
        const Replay replay = play_at(original, [&](const Frame& frame) {
            first.push_back(copy(frame));
            recorder.write(frame);
        });
        ASSERT_EQ(replay.end, VFIT_END_OF_STREAM) << replay.message;
    }
    size_t i = 0;
    int64_t offset_ns = 0;
    const Replay again = play({}, [&](const Frame& frame) {
        ASSERT_LT(i, first.size());
        const Copy& was = first[i];
        const Copy is = copy(frame);
        EXPECT_EQ(was.depth, is.depth);
        EXPECT_EQ(was.users, is.users);
        EXPECT_EQ(was.camera.fx, is.camera.fx);
        EXPECT_EQ(was.camera.floor_state, is.camera.floor_state);
        if (i == 0) offset_ns = is.time_ns - was.time_ns;
        EXPECT_EQ(is.time_ns - was.time_ns, offset_ns);
        for (int joint = 0; joint < kJointCount; ++joint) {
            ASSERT_EQ(was.body.has(joint), is.body.has(joint));
            if (was.body.has(joint)) {
                EXPECT_LT(glm::length(was.body.at(joint) - is.body.at(joint)), 1e-4f);
            }
        }
        ++i;
    });
    EXPECT_EQ(again.end, VFIT_END_OF_STREAM) << again.message;
    EXPECT_EQ(i, first.size());
}

}  // namespace
}  // namespace vfit::test
