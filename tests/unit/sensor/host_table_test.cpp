// Plug-ins that misuse the host's functions get an error code.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <future>
#include <thread>

#include "core/handles.h"
#include "fake_plugin.h"

namespace vfit::test {
namespace {

TEST(HostTable, AFrameHandleIsOfTheProcessWideTableUntilItIsPushed) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    vfit_frame frame{};
    ASSERT_EQ(fake.plugin.begin(frame), VFIT_OK);
    EXPECT_TRUE(Handles::instance().get(frame.id, Kind::frame));
    fake.plugin.set_intrinsics(frame);
    ASSERT_EQ(fake.plugin.push(frame), VFIT_OK);
    EXPECT_EQ(failure_of([&] { Handles::instance().get(frame.id, Kind::frame); }).code, VFIT_ERROR_HANDLE);
}

TEST(HostTable, PushingTwiceOrAfterADropIsAHandleError) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    vfit_frame frame{};
    fake.plugin.begin(frame);
    fake.plugin.set_intrinsics(frame);
    EXPECT_EQ(fake.plugin.push(frame), VFIT_OK);
    EXPECT_EQ(fake.plugin.push(frame), VFIT_ERROR_HANDLE);
    EXPECT_EQ(fake.plugin.set_intrinsics(frame), VFIT_ERROR_HANDLE);
    fake.plugin.begin(frame);
    fake.plugin.host->frame_drop(fake.plugin.host->self, frame);
    fake.plugin.host->frame_drop(fake.plugin.host->self, frame);
    EXPECT_EQ(fake.plugin.push(frame), VFIT_ERROR_HANDLE);
}

TEST(HostTable, AForeignFrameIsAHandleError) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    const auto frame = make<Frame>();
    const uint64_t id = Handles::instance().add(Kind::frame, frame, 0);
    void* pixels = nullptr;
    for (const vfit_frame foreign : {vfit_frame{id}, vfit_frame{0}, vfit_frame{0xDEADBEEF}}) {
        EXPECT_EQ(fake.plugin.push(foreign), VFIT_ERROR_HANDLE);
        EXPECT_EQ(fake.plugin.host->frame_pixels(fake.plugin.host->self, foreign, 0, &pixels, nullptr),
                  VFIT_ERROR_HANDLE);
        EXPECT_EQ(fake.plugin.add_joint(foreign, 0, 0, 0, 1), VFIT_ERROR_HANDLE);
    }
    EXPECT_TRUE(Handles::instance().get(id, Kind::frame)) << "the owner's handle is untouched";
    Handles::instance().release(id, Kind::frame);
}

TEST(HostTable, NullAndInventedArgumentsAreErrors) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    const vfit_host& h = *fake.plugin.host;
    vfit_frame frame{};
    const vfit_frame_layout layout{sizeof layout, VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 4, 2, 0};
    int on_the_stack = 0;
    EXPECT_EQ(h.frame_begin(h.self, fake.plugin.stream, nullptr, sizeof layout, 1, &frame),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_begin(h.self, fake.plugin.stream, &layout, sizeof layout, 1, nullptr),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_begin(h.self, fake.plugin.stream, &layout, 0, 1, &frame), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_begin(h.self, fake.plugin.stream, &layout, sizeof layout, 0, &frame),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_begin(h.self, fake.plugin.stream, &layout, sizeof layout, 99, &frame),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_begin(h.self, nullptr, &layout, sizeof layout, 1, &frame), VFIT_ERROR_HANDLE);
    EXPECT_EQ(h.frame_begin(h.self, &on_the_stack, &layout, sizeof layout, 1, &frame), VFIT_ERROR_HANDLE);
    EXPECT_EQ(h.frame_begin(nullptr, fake.plugin.stream, &layout, sizeof layout, 1, &frame),
              VFIT_ERROR_ARGUMENT);
    ASSERT_EQ(fake.plugin.begin(frame), VFIT_OK);
    EXPECT_EQ(h.frame_pixels(h.self, frame, VFIT_STREAM_DEPTH, nullptr, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_intrinsics(h.self, frame, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_camera(h.self, frame, nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_body(h.self, frame, nullptr, nullptr, 0, 0), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_meta(h.self, frame, nullptr, "1"), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_meta(h.self, frame, "index", nullptr), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_push(h.self, nullptr, frame, 0), VFIT_ERROR_ARGUMENT);
    h.log(h.self, 99, nullptr);
    h.sensor_added(h.self, nullptr);
    h.sensor_removed(h.self, nullptr);
    h.stream_state(h.self, nullptr, VFIT_END_OF_STREAM, nullptr);
    h.stream_state(h.self, fake.plugin.stream, VFIT_TIMEOUT, nullptr);
    EXPECT_EQ(sensor->describe().state, VFIT_OK);
}

TEST(HostTable, LayoutsMustBeThoseOfASensor) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    const vfit_host& h = *fake.plugin.host;
    const auto begin = [&](vfit_frame_layout layout) {
        vfit_frame frame{};
        layout.struct_size = sizeof layout;
        return h.frame_begin(h.self, fake.plugin.stream, &layout, sizeof layout, 1, &frame);
    };
    EXPECT_EQ(begin({0, VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 16385, 2, 0}), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(begin({0, VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 4, UINT32_MAX, 0}), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(begin({0, VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 0, 2, 0}), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(begin({0, VFIT_STREAM_DEPTH, VFIT_FORMAT_U8, 4, 2, 0}), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(begin({0, VFIT_STREAM_POSITION, VFIT_FORMAT_F32X3, 4, 2, 0}), VFIT_ERROR_ARGUMENT);
    const vfit_frame_layout twice[2] = {{sizeof twice[0], VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 4, 2, 0},
                                        {sizeof twice[0], VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 4, 2, 0}};
    const vfit_frame_layout unequal[2] = {{sizeof twice[0], VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, 4, 2, 0},
                                          {sizeof twice[0], VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, 2, 2, 0}};
    vfit_frame frame{};
    EXPECT_EQ(h.frame_begin(h.self, fake.plugin.stream, twice, sizeof twice[0], 2, &frame),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(h.frame_begin(h.self, fake.plugin.stream, unequal, sizeof twice[0], 2, &frame),
              VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(fake.plugin.push_frame(1), VFIT_OK) << "refused frames went back to the pool";
}

TEST(HostTable, ABodyThatIsNotFiniteIsDroppedAndLoggedOnce) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    for (int i = 0; i < 3; ++i) {
        vfit_frame handle{};
        fake.plugin.begin(handle);
        fake.plugin.set_intrinsics(handle);
        EXPECT_EQ(fake.plugin.add_joint(handle, VFIT_JOINT_HEAD, NAN, 0, 2), VFIT_ERROR_DATA);
        EXPECT_EQ(fake.plugin.add_joint(handle, VFIT_JOINT_HEAD, 0, 0, 2, 2), VFIT_OK);
        EXPECT_EQ(fake.plugin.push(handle), VFIT_OK);
        Ref<Frame> frame;
        ASSERT_EQ(sensor->acquire(0, frame), VFIT_OK);
        ASSERT_EQ(frame->bodies.size(), 1u);
        EXPECT_EQ(frame->bodies[0].id, 2u);
    }
    EXPECT_EQ(fake.lines_with("HEAD is not finite"), 1u);
}

TEST(HostTable, JointsAndBodyIdsAreChecked) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    vfit_frame frame{};
    fake.plugin.begin(frame);
    EXPECT_EQ(fake.plugin.add_joint(frame, VFIT_JOINT_COUNT, 0, 0, 1), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(fake.plugin.add_joint(frame, -1, 0, 0, 1), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(fake.plugin.add_joint(frame, 0, 0, 0, 1, 0), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(fake.plugin.add_joint(frame, 0, 0, 0, 1, 256), VFIT_ERROR_ARGUMENT);
}

TEST(HostTable, CamerasAreChecked) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    const vfit_host& h = *fake.plugin.host;
    vfit_frame frame{};
    fake.plugin.begin(frame);
    vfit_intrinsics in = vfit_intrinsics_init();
    in.width = 4;
    in.height = 2;
    in.fx = NAN;
    in.fy = 1.0f;
    EXPECT_EQ(h.frame_intrinsics(h.self, frame, &in), VFIT_ERROR_ARGUMENT);
    in.fx = 1.0f;
    in.distortion[3] = INFINITY;
    EXPECT_EQ(h.frame_intrinsics(h.self, frame, &in), VFIT_ERROR_ARGUMENT);
    vfit_camera camera = vfit_camera_init();
    camera.floor_state = VFIT_FLOOR_GIVEN;  // with a normal of zero length
    EXPECT_EQ(h.frame_camera(h.self, frame, &camera), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(fake.plugin.push(frame), VFIT_ERROR_ARGUMENT) << "a depth image without intrinsics";
    fake.plugin.begin(frame);
    fake.plugin.set_intrinsics(frame, 2, 4);
    EXPECT_EQ(fake.plugin.push(frame), VFIT_ERROR_ARGUMENT) << "intrinsics of another size";
    fake.plugin.begin(frame);
    fake.plugin.set_intrinsics(frame);
    EXPECT_EQ(fake.plugin.push(frame, -5), VFIT_ERROR_ARGUMENT);
    fake.plugin.begin(frame);
    fake.plugin.set_intrinsics(frame);
    EXPECT_EQ(fake.plugin.push(frame, INT64_MAX), VFIT_ERROR_ARGUMENT);
}

TEST(HostTable, PushAfterStopAndAfterCloseIsRefused) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    vfit_frame frame{};
    fake.plugin.begin(frame);
    sensor->stop();
    fake.plugin.set_intrinsics(frame);
    EXPECT_EQ(fake.plugin.push(frame), VFIT_ERROR_STATE);
    EXPECT_EQ(fake.plugin.begin(frame), VFIT_ERROR_STATE);
    sensor->start();
    fake.plugin.begin(frame);
    sensor->close();
    void* pixels = nullptr;
    fake.plugin.host->frame_pixels(fake.plugin.host->self, frame, VFIT_STREAM_DEPTH, &pixels, nullptr);
    std::memset(pixels, 0xFF, 16);  // the plug-in's thread was late: its frame is still its own
    EXPECT_EQ(fake.plugin.push(frame), VFIT_ERROR_HANDLE);
    EXPECT_EQ(fake.plugin.begin(frame), VFIT_ERROR_HANDLE);
    fake.plugin.end_stream(VFIT_END_OF_STREAM);
}

TEST(HostTable, AFrameOfOneDeviceIsNotPushedThroughAnother) {
    FakeHost fake;
    const Ref<Sensor> first = fake.open_and_start();
    void* const first_stream = fake.plugin.stream;
    const Ref<Sensor> second = fake.host.open("fake:2");
    second->start();
    ASSERT_NE(fake.plugin.stream, first_stream);
    vfit_frame frame{};
    fake.plugin.begin(frame);
    fake.plugin.set_intrinsics(frame);
    const vfit_host& h = *fake.plugin.host;
    EXPECT_EQ(h.frame_push(h.self, first_stream, frame, 0), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(first->describe().received, 0u);
}

TEST(HostTable, AnEmptyPoolIsBusyInRealtimeAndWaitsWithoutPace) {
    FakeHost fake;
    fake.plugin.pace = "realtime";
    const Ref<Sensor> sensor = fake.open_and_start();
    std::vector<Ref<Frame>> held(8);
    for (Ref<Frame>& frame : held) {
        ASSERT_EQ(fake.plugin.push_frame(1), VFIT_OK);
        ASSERT_EQ(sensor->acquire(0, frame), VFIT_OK);
    }
    EXPECT_EQ(fake.plugin.push_frame(1), VFIT_ERROR_BUSY);
    fake.plugin.pace = "none";
    sensor->set_option("pace", "none");
    auto waiting = std::async(std::launch::async, [&] { return fake.plugin.push_frame(7); });
    EXPECT_EQ(waiting.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
    held[3] = nullptr;
    EXPECT_EQ(waiting.get(), VFIT_OK);
    auto stopped = std::async(std::launch::async, [&] { return fake.plugin.push_frame(8); });
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    sensor->stop();
    EXPECT_EQ(stopped.get(), VFIT_ERROR_STATE);
}

TEST(HostTable, ThreadsMayPushWhileOthersAcquireAndTheSensorRestarts) {
    FakeHost fake;
    fake.plugin.pace = "realtime";
    const Ref<Sensor> sensor = fake.open_and_start();
    std::atomic<bool> done{false};
    std::vector<std::thread> threads;
    for (int t = 0; t < 3; ++t)
        threads.emplace_back([&] {
            while (!done) {
                const vfit_result result = fake.plugin.push_frame(3);
                EXPECT_TRUE(result == VFIT_OK || result == VFIT_ERROR_BUSY || result == VFIT_ERROR_STATE ||
                            result == VFIT_ERROR_HANDLE)
                    << result;
                std::this_thread::yield();
            }
        });
    threads.emplace_back([&] {
        while (!done) {
            Ref<Frame> frame;
            failure_of([&] {
                if (sensor->acquire(1'000'000, frame) == VFIT_OK) {
                    EXPECT_EQ(frame->find(VFIT_STREAM_DEPTH)->as<uint16_t>()[0], 3);
                }
            });
        }
    });
    for (int i = 0; i < 30; ++i) {
        sensor->stop();
        sensor->start();
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
        const vfit_sensor_stats now = sensor->describe();  // one moment: frames come in meanwhile
        EXPECT_LE(now.taken + now.dropped, now.received);
    }
    done = true;
    for (std::thread& thread : threads) thread.join();
    sensor->close();
}

TEST(HostTable, MetaTextsReachTheFrame) {
    FakeHost fake;
    const Ref<Sensor> sensor = fake.open_and_start();
    const vfit_host& h = *fake.plugin.host;
    vfit_frame handle{};
    fake.plugin.begin(handle);
    fake.plugin.set_intrinsics(handle);
    EXPECT_EQ(h.frame_meta(h.self, handle, "index", "12"), VFIT_OK);
    EXPECT_EQ(h.frame_meta(h.self, handle, std::string(100, 'k').c_str(), "12"), VFIT_ERROR_ARGUMENT);
    fake.plugin.push(handle);
    Ref<Frame> frame;
    ASSERT_EQ(sensor->acquire(0, frame), VFIT_OK);
    ASSERT_TRUE(frame->meta("index"));
    EXPECT_EQ(*frame->meta("index"), "12");
}

}  // namespace
}  // namespace vfit::test
