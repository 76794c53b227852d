// Hand-over between one pushing and one taking thread.
#include "sensor/frame_queue.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <thread>

#include "core/clock.h"
#include "fake_plugin.h"

namespace vfit {
namespace {

using namespace std::chrono_literals;

Ref<Frame> frame_at(int64_t time_ns) {
    auto frame = make<Frame>();
    frame->time_ns = time_ns;
    return frame;
}

TEST(FrameQueue, RealtimeReplacesAFrameThatNobodyTookAndCountsIt) {
    FrameQueue queue;
    queue.open();
    EXPECT_EQ(queue.push(frame_at(1)), VFIT_OK);
    EXPECT_EQ(queue.push(frame_at(2)), VFIT_OK);
    Ref<Frame> frame;
    ASSERT_EQ(queue.take(0, frame), VFIT_OK);
    EXPECT_EQ(frame->time_ns, 2);
    const vfit_sensor_stats stats = queue.describe();
    EXPECT_EQ(stats.received, 2u);
    EXPECT_EQ(stats.taken, 1u);
    EXPECT_EQ(stats.dropped, 1u);
}

TEST(FrameQueue, EachFrameIsTakenOnce) {
    FrameQueue queue;
    queue.open();
    queue.push(frame_at(1));
    Ref<Frame> frame;
    EXPECT_EQ(queue.take(0, frame), VFIT_OK);
    EXPECT_EQ(queue.take(0, frame), VFIT_NOT_READY);
    EXPECT_EQ(queue.take(1'000'000, frame), VFIT_TIMEOUT);
}

TEST(FrameQueue, LatencyIsFromTimeStampToHandOver) {
    FrameQueue queue;
    queue.open();
    queue.push(frame_at(now_ns() - 50'000'000));
    Ref<Frame> frame;
    ASSERT_EQ(queue.take(0, frame), VFIT_OK);
    EXPECT_GE(queue.describe().latency_ns, 50'000'000);
    EXPECT_LT(queue.describe().latency_ns, 5'000'000'000);
}

TEST(FrameQueue, WithoutPaceEveryFrameArrivesInOrder) {
    FrameQueue queue;
    queue.set_pace(Pace::none);
    queue.open();
    std::thread pusher([&] {
        for (int i = 1; i <= 2000; ++i) ASSERT_EQ(queue.push(frame_at(i)), VFIT_OK);
        queue.set_state(VFIT_END_OF_STREAM, "");
    });
    Ref<Frame> frame;
    for (int i = 1; i <= 2000; ++i) {
        ASSERT_EQ(queue.take(-1, frame), VFIT_OK);
        ASSERT_EQ(frame->time_ns, i);
    }
    EXPECT_EQ(queue.take(-1, frame), VFIT_END_OF_STREAM);
    pusher.join();
    EXPECT_EQ(queue.describe().dropped, 0u);
}

TEST(FrameQueue, WithoutPaceAPushWaitsUntilTheFrameBeforeWasTaken) {
    FrameQueue queue;
    queue.set_pace(Pace::none);
    queue.open();
    queue.push(frame_at(1));
    auto second = std::async(std::launch::async, [&] { return queue.push(frame_at(2)); });
    EXPECT_EQ(second.wait_for(30ms), std::future_status::timeout);
    Ref<Frame> frame;
    queue.take(0, frame);
    EXPECT_EQ(second.get(), VFIT_OK);
}

TEST(FrameQueue, ClosingWakesAWaitingPush) {
    FrameQueue queue;
    queue.set_pace(Pace::none);
    queue.open();
    queue.push(frame_at(1));
    auto second = std::async(std::launch::async, [&] { return queue.push(frame_at(2)); });
    std::this_thread::sleep_for(10ms);
    queue.close();
    EXPECT_EQ(second.get(), VFIT_ERROR_STATE);
}

TEST(FrameQueue, ClosingWakesAWaitingTakeWithAStateError) {
    FrameQueue queue;
    queue.open();
    auto taken = std::async(std::launch::async, [&] {
        Ref<Frame> frame;
        return test::failure_of([&] { queue.take(-1, frame); }).code;
    });
    std::this_thread::sleep_for(10ms);
    queue.close();
    EXPECT_EQ(taken.get(), VFIT_ERROR_STATE);
}

TEST(FrameQueue, TheEndComesAfterTheLastFrame) {
    FrameQueue queue;
    queue.open();
    queue.push(frame_at(1));
    queue.set_state(VFIT_END_OF_STREAM, "");
    Ref<Frame> frame;
    EXPECT_EQ(queue.take(0, frame), VFIT_OK);
    EXPECT_EQ(queue.take(0, frame), VFIT_END_OF_STREAM);
    EXPECT_EQ(queue.take(-1, frame), VFIT_END_OF_STREAM);
    EXPECT_EQ(queue.push(frame_at(2)), VFIT_ERROR_STATE);
}

TEST(FrameQueue, AnErrorOfTheStreamComesAfterTheLastFrameWithItsSentence) {
    FrameQueue queue;
    queue.open();
    queue.push(frame_at(1));
    queue.set_state(VFIT_ERROR_DEVICE_LOST, "the cable was pulled");
    Ref<Frame> frame;
    EXPECT_EQ(queue.take(0, frame), VFIT_OK);
    const auto failure = test::failure_of([&] { queue.take(0, frame); });
    EXPECT_EQ(failure.code, VFIT_ERROR_DEVICE_LOST);
    EXPECT_EQ(failure.message, "the cable was pulled");
    EXPECT_EQ(queue.describe().state, VFIT_ERROR_DEVICE_LOST);
    queue.set_state(VFIT_OK, "");  // plugged in again
    EXPECT_EQ(queue.push(frame_at(2)), VFIT_OK);
    EXPECT_EQ(queue.take(0, frame), VFIT_OK);
}

TEST(FrameQueue, TheLongestTimeoutDoesNotOverflow) {
    FrameQueue queue;
    queue.open();
    queue.push(frame_at(1));
    Ref<Frame> frame;
    EXPECT_EQ(queue.take(INT64_MAX, frame), VFIT_OK);
}

TEST(FrameQueue, OpeningAgainForgetsTheRoundBefore) {
    FrameQueue queue;
    queue.open();
    queue.push(frame_at(1));
    queue.set_state(VFIT_END_OF_STREAM, "");
    queue.close();
    queue.open();
    Ref<Frame> frame;
    EXPECT_EQ(queue.take(0, frame), VFIT_NOT_READY);
    EXPECT_EQ(queue.describe().received, 0u);
}

}  // namespace
}  // namespace vfit
