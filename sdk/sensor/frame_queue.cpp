#include "sensor/frame_queue.h"

#include <algorithm>
#include <chrono>

#include "core/clock.h"
#include "core/error.h"

namespace vfit {

namespace {

// Longer waits are cut to this, so that deadlines do not overflow: 10 years.
constexpr int64_t kLongestWaitNs = 315'360'000'000'000'000;
// Frames come back to a pool on any thread and without a signal; this long is slept between two looks.
constexpr std::chrono::milliseconds kPoolLook{1};

}  // namespace

void FrameQueue::set_pace(Pace pace) {
    std::lock_guard lock(mutex_);
    pace_ = pace;
    changed_.notify_all();
}

Pace FrameQueue::pace() const {
    std::lock_guard lock(mutex_);
    return pace_;
}

void FrameQueue::open() {
    Ref<Frame> old;
    std::lock_guard lock(mutex_);
    std::swap(old, newest_);
    open_ = true;
    state_ = VFIT_OK;
    message_.clear();
    received_ = taken_ = dropped_ = 0;
    latency_ns_ = 0;
}

void FrameQueue::close() {
    Ref<Frame> old;
    std::lock_guard lock(mutex_);
    std::swap(old, newest_);
    open_ = false;
    changed_.notify_all();
}

bool FrameQueue::is_open() const {
    std::lock_guard lock(mutex_);
    return open_;
}

vfit_result FrameQueue::push(Ref<Frame> frame) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !open_ || state_ != VFIT_OK || pace_ == Pace::realtime || !newest_; });
    if (!open_ || state_ != VFIT_OK) return VFIT_ERROR_STATE;
    if (newest_) ++dropped_;
    ++received_;
    std::swap(newest_, frame);
    changed_.notify_all();
    lock.unlock();  // the replaced frame goes back to its pool outside the lock
    return VFIT_OK;
}

void FrameQueue::set_state(vfit_result state, const std::string& message) {
    std::lock_guard lock(mutex_);
    state_ = state;
    message_ = message;
    changed_.notify_all();
}

vfit_result FrameQueue::take(int64_t timeout_ns, Ref<Frame>& out) {
    std::unique_lock lock(mutex_);
    const auto news = [&] { return !open_ || newest_ || state_ != VFIT_OK; };
    if (timeout_ns < 0)
        changed_.wait(lock, news);
    else if (timeout_ns > 0)
        changed_.wait_for(lock, std::chrono::nanoseconds(std::min(timeout_ns, kLongestWaitNs)), news);
    if (!open_) fail(VFIT_ERROR_STATE, "the sensor is not running");
    if (newest_) {
        out = std::move(newest_);
        newest_ = nullptr;
        ++taken_;
        latency_ns_ = now_ns() - out->time_ns;
        changed_.notify_all();
        return VFIT_OK;
    }
    if (state_ < 0) fail(state_, message_);
    if (state_ != VFIT_OK) return state_;
    return timeout_ns == 0 ? VFIT_NOT_READY : VFIT_TIMEOUT;
}

bool FrameQueue::wait_for_pool() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kPoolLook, [&] { return !open_; });
    return open_;
}

vfit_sensor_stats FrameQueue::describe() const {
    std::lock_guard lock(mutex_);
    vfit_sensor_stats stats = vfit_sensor_stats_init();
    stats.running = open_;
    stats.state = state_;
    stats.received = received_;
    stats.taken = taken_;
    stats.dropped = dropped_;
    stats.latency_ns = latency_ns_;
    return stats;
}

}  // namespace vfit
