// The stream of one open device: its bounded pool, the checks on what a plug-in pushes, the floor that is
// estimated where nobody knows it, and the hand-over.
#pragma once

#include <mutex>

#include "frame/frame.h"
#include "sensor/frame_queue.h"
#include "vfit_plugin.h"

namespace vfit {

class SensorStream : public Object {
public:
    explicit SensorStream(Ref<FrameBytes> total = nullptr)
        : pool_(make<FramePool>(kPoolFrames, std::move(total))) {}

    FrameQueue queue;

    /// Accepts frames; the floor is estimated anew.
    void open();

    /// A frame with those streams to fill. Fails with VFIT_ERROR_BUSY (realtime: the pool is empty) or
    /// VFIT_ERROR_STATE (the stream is stopping).
    Ref<Frame> begin(const vfit_frame_layout* layouts, uint32_t stride, uint32_t count);

    /// Carries the bodies from camera to world space and hands the frame over. Fails with
    /// VFIT_ERROR_ARGUMENT where the camera does not fit the image, with VFIT_ERROR_STATE when stopping.
    void push(Ref<Frame> frame, int64_t time_ns);

private:
    static constexpr uint32_t kPoolFrames = 8;  // three in flight, the rest for a host that holds some

    void find_floor(Frame& frame);

    const Ref<FramePool> pool_;
    std::mutex floor_mutex_;
    bool has_floor_ = false;
    Camera floor_;
};

}  // namespace vfit
