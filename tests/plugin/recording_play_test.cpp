// Playing a sound recording.
#include <atomic>
#include <cstring>
#include <thread>

#include "core/clock.h"
#include "recording_support.h"

namespace vfit::test {
namespace {

TEST_F(RecordingTest, PlaysBackWhatTheRecorderWrote) {
    record(4);
    const Replay replay = play();
    EXPECT_EQ(replay.end, VFIT_END_OF_STREAM) << replay.message;
    ASSERT_EQ(replay.frames.size(), 4u);
    for (uint32_t i = 0; i < 4; ++i) {
        const Frame& frame = *replay.frames[i];
        const Ref<Frame> original = synthetic_frame(i);
        EXPECT_TRUE(depth_is_synthetic(frame, i));
        EXPECT_EQ(frame.time_ns - replay.frames[0]->time_ns, original->time_ns - synthetic_frame(0)->time_ns);
        EXPECT_EQ(*frame.meta("index"), std::to_string(i));
        EXPECT_EQ(*frame.meta("contacts"), *original->meta("contacts"));
        EXPECT_EQ(*frame.meta("measures"), *original->meta("measures"));
        EXPECT_EQ(frame.camera.floor_state, VFIT_FLOOR_GIVEN);
        EXPECT_NEAR(frame.camera.tilt_rad(), 0.1f, 1e-5f);
        EXPECT_FLOAT_EQ(frame.camera.fx, 28.5f);
        ASSERT_EQ(frame.bodies.size(), 1u);
        for (const int joint : {VFIT_JOINT_HEAD, VFIT_JOINT_LEFT_FOOT}) {
            const Vec3 error = frame.bodies[0].at(joint) - original->bodies[0].at(joint);
            EXPECT_LT(glm::length(error), 1e-5f);
        }
        EXPECT_FLOAT_EQ(frame.bodies[0].joints[VFIT_JOINT_HEAD].confidence, 0.5f);
        EXPECT_FALSE(frame.bodies[0].has(VFIT_JOINT_NECK));
    }
}

TEST_F(RecordingTest, APlainPathIsEnough) {
    record(1);
    const Ref<Sensor> sensor = host_.open(folder_.string());
    ASSERT_EQ(sensor->modes().size(), 1u);
    EXPECT_EQ(sensor->modes()[0].width, kWidth);
    EXPECT_FLOAT_EQ(sensor->modes()[0].rate_hz, 30.0f);
    sensor->set_option("mode", sensor->modes()[0].name);
    sensor->close();
}

TEST_F(RecordingTest, MirroredImagesAreTurnedBack) {
    record(1);
    edit("camera.json", "\"fx\"", "\"mirrored\": true, \"fx\"");
    edit("camera.json", "\"cx\": 15.5", "\"cx\": 14.5");
    const Replay replay = play();
    ASSERT_EQ(replay.frames.size(), 1u) << replay.message;
    const DepthImage image = replay.frames[0]->depth_image();
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
            ASSERT_EQ(image.depth[y * kWidth + x], depth_at(0, y * kWidth + kWidth - 1 - x));
    EXPECT_FLOAT_EQ(image.camera.cx, float(kWidth - 1) - 14.5f);
    edit("camera.json", "\"mirrored\": true", "\"mirrored\": 1");
    EXPECT_TRUE(play().says("\"mirrored\" is neither true nor false"));
}

TEST_F(RecordingTest, ACameraMayBeRolled) {
    record(1);
    const std::string all = read("camera.json");
    const size_t at = all.find("\"floor\"");
    ASSERT_NE(at, std::string::npos);
    const std::string before = all.substr(0, at), after = "}";
    write("camera.json", before + R"("camera_height_m": 2.2, "tilt_deg": 30, "roll_deg": -25)" + after);
    const Replay replay = play();
    ASSERT_EQ(replay.frames.size(), 1u) << replay.message;
    const Camera& camera = replay.frames[0]->camera;
    EXPECT_EQ(camera.floor_state, VFIT_FLOOR_GIVEN);
    EXPECT_NEAR(camera.floor_distance_m, 2.2f, 1e-5f);
    EXPECT_NEAR(camera.tilt_rad(), 30.0f * kPi / 180.0f, 1e-5f);
    EXPECT_NEAR(camera.roll_rad(), -25.0f * kPi / 180.0f, 1e-5f);
    write("camera.json", before + R"("roll_deg": -25)" + after);
    EXPECT_TRUE(play().says("roll_deg")) << play().message;
}

TEST_F(RecordingTest, StartAndCountChooseFrames) {
    record(9);
    const Replay replay = play([](Sensor& sensor) {
        sensor.set_option("start", "3");
        sensor.set_option("count", "4");
    });
    EXPECT_EQ(replay.count, 4u);
    EXPECT_TRUE(depth_is_synthetic(*replay.frames.at(0), 3));
    EXPECT_NEAR(replay.frames[0]->bodies.at(0).at(VFIT_JOINT_HEAD).x,
                synthetic_frame(3)->bodies[0].at(VFIT_JOINT_HEAD).x, 1e-5f);
    EXPECT_EQ(play([](Sensor& sensor) { sensor.set_option("count", "400"); }).count, 9u);
}

TEST_F(RecordingTest, ALoopBeginsAgainWhileTimeGoesOn) {
    record(3);
    int64_t last = 0;
    size_t number = 0;
    const Replay replay = play([](Sensor& sensor) { sensor.set_option("loop", "1"); },
                               [&](const Frame& frame) {
                                   EXPECT_GT(frame.time_ns, last);
                                   EXPECT_TRUE(depth_is_synthetic(frame, number++ % 3));
                                   EXPECT_EQ(frame.bodies.size(), 1u);
                                   last = frame.time_ns;
                               },
                               20);
    EXPECT_EQ(replay.count, 20u);
}

TEST_F(RecordingTest, OptionsAreChecked) {
    record(3);
    const Ref<Sensor> sensor = open();
    const auto code = [&](const char* key, const char* value) {
        try {
            sensor->set_option(key, value);
        } catch (const Error& error) {
            return error.code();
        }
        return vfit_result(VFIT_OK);
    };
    EXPECT_EQ(code("start", "3"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(code("start", "-1"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(code("start", "1x"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(code("count", "99999999999"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(code("loop", "2"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(code("pace", "slow"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(code("volume", "1"), VFIT_ERROR_UNSUPPORTED);
    EXPECT_EQ(code("start", "2"), VFIT_OK);
    sensor->start();
    EXPECT_EQ(code("start", "0"), VFIT_ERROR_STATE);
    std::string keys;
    for (const vfit_sensor_option& option : sensor->options())
        keys += std::string(option.key) + "=" + option.value + " ";
    EXPECT_EQ(keys, "pace=none loop=0 start=2 count=0 mode=32x24@30 ");
    sensor->close();
}

TEST_F(RecordingTest, RealtimeTakesAsLongAsTheRecordingDid) {
    record(7);
    const Stopwatch watch;
    const Replay replay = play([](Sensor& sensor) { sensor.set_option("pace", "realtime"); });
    EXPECT_EQ(replay.end, VFIT_END_OF_STREAM);
    EXPECT_GE(watch.ms(), 6 * 33.3 - 1.0);
    EXPECT_GE(replay.count, 1u);
}

TEST_F(RecordingTest, StopInTheMiddleOfAWaitIsQuick) {
    record(2);
    write("timestamps.csv", "frame,time_ns\n0,0\n1,3600000000000\n");
    const Ref<Sensor> sensor = open();
    sensor->set_option("pace", "realtime");
    sensor->start();
    Ref<Frame> frame;
    EXPECT_EQ(sensor->acquire(20'000'000'000, frame), VFIT_OK);
    const Stopwatch watch;
    sensor->stop();
    EXPECT_LT(watch.ms(), 2000.0);
    sensor->start();
    EXPECT_EQ(sensor->acquire(20'000'000'000, frame), VFIT_OK) << "it begins again";
    EXPECT_EQ(*frame->meta("index"), "0");
    sensor->close();
}

TEST_F(RecordingTest, SegmentedDepthIsTheUserMapWhereThereIsNoMask) {
    record(1, {"test", 30.0f, true});
    const Replay replay = play();
    const auto* users = replay.frames.at(0)->find(VFIT_STREAM_USER_MAP);
    ASSERT_TRUE(users);
    for (uint32_t i = 0; i < kWidth * kHeight; ++i)
        ASSERT_EQ(users->as<uint8_t>()[i], depth_at(0, i) > 0 ? 1 : 0);
    record(1);
    EXPECT_FALSE(play().frames.at(0)->find(VFIT_STREAM_USER_MAP));
}

TEST_F(RecordingTest, MaskAndColourComeBackAsTheyWere) {
    const auto frame = synthetic_frame(0);
    auto* users =
        static_cast<uint8_t*>(frame->add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, kWidth, kHeight));
    auto* color =
        static_cast<uint8_t*>(frame->add_stream(VFIT_STREAM_COLOR, VFIT_FORMAT_RGBA8, kWidth, kHeight));
    for (uint32_t i = 0; i < kWidth * kHeight; ++i) users[i] = static_cast<uint8_t>(i % 255);
    for (uint32_t i = 0; i < 4 * kWidth * kHeight; ++i) color[i] = static_cast<uint8_t>(i * 7);
    Recorder(folder_.string(), {}).write(*frame);
    const Replay replay = play();
    ASSERT_EQ(replay.count, 1u) << replay.message;
    EXPECT_EQ(std::memcmp(replay.frames[0]->find(VFIT_STREAM_USER_MAP)->data, users, kWidth * kHeight), 0);
    EXPECT_EQ(std::memcmp(replay.frames[0]->find(VFIT_STREAM_COLOR)->data, color, 4 * kWidth * kHeight), 0);
}

TEST_F(RecordingTest, SeveralPeopleHaveTheirIds) {
    record(2);
    write("joints.csv", "frame,id,HEAD_x,HEAD_y,HEAD_z\n0,4,0,0,2\n0,9,1,0,2\n1,9,1,0,2\n");
    const Replay replay = play();
    ASSERT_EQ(replay.frames.size(), 2u) << replay.message;
    EXPECT_EQ(replay.frames[0]->bodies.size(), 2u);
    EXPECT_TRUE(replay.frames[0]->body(4));
    EXPECT_TRUE(replay.frames[0]->body(9));
    EXPECT_FALSE(replay.frames[1]->body(4));
    EXPECT_FLOAT_EQ(replay.frames[1]->body(9)->joints[VFIT_JOINT_HEAD].confidence, 1.0f);
}

TEST_F(RecordingTest, FramesWithoutTimeStampsAreAPeriodApart) {
    record(3);
    fs::remove(folder_ / "timestamps.csv");
    Replay replay = play();
    EXPECT_EQ(replay.frames.at(2)->time_ns - replay.frames.at(0)->time_ns, 66'666'667);
    write("timestamps.csv", "frame,time_ns\n0,1000000000\n2,1050000000\n");
    replay = play();
    EXPECT_EQ(replay.frames.at(1)->time_ns - replay.frames.at(0)->time_ns, 33'333'333);
    EXPECT_EQ(replay.frames.at(2)->time_ns - replay.frames.at(0)->time_ns, 50'000'000);
}

TEST_F(RecordingTest, MeasuresMayLieOneFolderHigher) {
    const fs::path above = folder_;
    folder_ = above / "front";
    record(1);
    fs::remove(folder_ / "measures.json");
    std::ofstream(above / "measures.json") << R"({"stature_m": 1.5})";
    EXPECT_EQ(*play().frames.at(0)->meta("measures"), R"({"stature_m":1.5})");
    folder_ = above;
}

TEST_F(RecordingTest, ATableWithoutItsLastLineEndIsReadWhole) {
    record(2);
    write("joints.csv", "frame,HEAD_x,HEAD_y,HEAD_z\n0,0.1250,0,2.1250\n1,0.1250,0,2.2500");
    EXPECT_EQ(play().frames.at(1)->bodies.size(), 1u);
    // Cut, as it seems.
    write("joints.csv", "frame,HEAD_x,HEAD_y,HEAD_z\n0,0.1250,0,2.1250\n1,0.1250,0,2.25");
    EXPECT_EQ(play().frames.at(1)->bodies.size(), 0u);
}

TEST_F(RecordingTest, TwoContextsPlayAtTheSameTime) {
    record(30);
    PluginHost other(log_, [] { return uint64_t(0); });
    other.load(std::string(VFIT_PLUGIN_DIR "/vfit_recording") + library_suffix());
    std::atomic<int> counted{0};
    const auto run = [&](PluginHost& host) {
        const Ref<Sensor> sensor = host.open(folder_.string());
        sensor->start();
        Ref<Frame> frame;
        for (uint32_t i = 0; sensor->acquire(20'000'000'000, frame) == VFIT_OK; ++i)
            counted += depth_is_synthetic(*frame, i);
        sensor->close();
    };
    std::thread second([&] { run(other); });
    run(host_);
    second.join();
    EXPECT_EQ(counted, 60);
}

}  // namespace
}  // namespace vfit::test
