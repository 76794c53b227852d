// Hand-over of the newest frame from a plug-in's thread to the host: one place, two paces, one end.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>

#include "frame/frame.h"
#include "vfit.h"

namespace vfit {

enum class Pace {
    realtime,  // the newest frame replaces one that nobody took
    none       // a push waits until the frame before was taken: nothing is dropped
};

/// All calls are [any].
class FrameQueue {
public:
    void set_pace(Pace pace);
    Pace pace() const;

    /// Empties it and accepts frames again.
    void open();
    /// Wakes every waiting push and take; both give VFIT_ERROR_STATE until the next open().
    void close();
    bool is_open() const;

    /// VFIT_OK, or VFIT_ERROR_STATE where the queue was closed or its stream has ended.
    vfit_result push(Ref<Frame> frame);
    /// The stream's state changed: VFIT_END_OF_STREAM, an error, or VFIT_OK after VFIT_ERROR_DEVICE_LOST.
    /// A frame that waits is still handed over first.
    void set_state(vfit_result state, const std::string& message);

    /// VFIT_OK with a frame; VFIT_NOT_READY (timeout_ns 0), VFIT_TIMEOUT or VFIT_END_OF_STREAM without. Fails
    /// with VFIT_ERROR_STATE where it is closed, and with the stream's own error where that ended.
    vfit_result take(int64_t timeout_ns, Ref<Frame>& out);

    /// Waits a moment for frames to come back to a pool; false where the queue was closed meanwhile.
    bool wait_for_pool();

    vfit_sensor_stats describe() const;

private:
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    Pace pace_ = Pace::realtime;
    bool open_ = false;
    Ref<Frame> newest_;
    vfit_result state_ = VFIT_OK;
    std::string message_;
    uint64_t received_ = 0, taken_ = 0, dropped_ = 0;
    int64_t latency_ns_ = 0;
};

}  // namespace vfit
