#include "sensor/sensor_stream.h"

#include "core/clock.h"
#include "core/error.h"
#include "frame/floor.h"
#include "sensor/sized_struct.h"

namespace vfit {

namespace {

constexpr uint32_t kMaxStreams = 3;   // depth, colour, user map
constexpr uint32_t kMaxSide = 16384;  // pixels
// Farthest a time stamp may lie in the future of the host's clock: a replay without pace runs ahead. 1 year.
constexpr int64_t kFarthestFutureNs = 31'536'000'000'000'000;

vfit_format wanted_format(vfit_stream kind) {
    switch (kind) {
        case VFIT_STREAM_DEPTH: return VFIT_FORMAT_U16;
        case VFIT_STREAM_COLOR: return VFIT_FORMAT_RGBA8;
        case VFIT_STREAM_USER_MAP: return VFIT_FORMAT_U8;
        default: return VFIT_FORMAT_NONE;
    }
}

void check(const vfit_frame_layout& layout) {
    const vfit_format wanted = wanted_format(layout.stream);
    if (wanted == VFIT_FORMAT_NONE)
        fail(VFIT_ERROR_ARGUMENT, "stream ", layout.stream, " is none of a sensor");
    if (layout.format != wanted)
        fail(VFIT_ERROR_ARGUMENT, "stream ", layout.stream, " has format ", layout.format, ", not ", wanted);
    if (layout.width == 0 || layout.height == 0 || layout.width > kMaxSide || layout.height > kMaxSide)
        fail(VFIT_ERROR_ARGUMENT, "stream ", layout.stream, ": size ", layout.width, " x ", layout.height,
             " is not in 1..", kMaxSide);
}

}  // namespace

void SensorStream::open() {
    {
        std::lock_guard lock(floor_mutex_);
        has_floor_ = false;
    }
    queue.open();
}

Ref<Frame> SensorStream::begin(const vfit_frame_layout* layouts, uint32_t stride, uint32_t count) {
    if (count == 0 || count > kMaxStreams)
        fail(VFIT_ERROR_ARGUMENT, "a frame of ", count, " streams; 1 to ", kMaxStreams, " are possible");
    vfit_frame_layout checked[kMaxStreams];
    for (uint32_t i = 0; i < count; ++i) {
        if (!layouts) fail(VFIT_ERROR_ARGUMENT, "layouts is null");
        const char* item = reinterpret_cast<const char*>(layouts) + size_t(i) * stride;
        checked[i] = read_sized<vfit_frame_layout>(item, stride, "layout");
        check(checked[i]);
    }
    if (!queue.is_open()) fail(VFIT_ERROR_STATE, "the stream is not running");
    Ref<Frame> frame = pool_->take();
    while (!frame) {
        if (queue.pace() == Pace::realtime) fail(VFIT_ERROR_BUSY, "all frames of the sensor are held");
        if (!queue.wait_for_pool()) fail(VFIT_ERROR_STATE, "the stream is stopping");
        frame = pool_->take();
    }
    for (uint32_t i = 0; i < count; ++i)
        frame->add_stream(checked[i].stream, checked[i].format, checked[i].width, checked[i].height);
    const Stream* depth = frame->find(VFIT_STREAM_DEPTH);
    const Stream* users = frame->find(VFIT_STREAM_USER_MAP);
    if (depth && users && (depth->width != users->width || depth->height != users->height))
        fail(VFIT_ERROR_ARGUMENT, "the user map's size is not that of the depth image");
    return frame;
}

void SensorStream::push(Ref<Frame> frame, int64_t time_ns) {
    const int64_t now = now_ns();
    if (time_ns == 0) time_ns = now;
    if (time_ns < 0 || time_ns > now + kFarthestFutureNs)
        fail(VFIT_ERROR_ARGUMENT, "time stamp ", time_ns, " ns is not on the host's clock");
    Camera& camera = frame->camera;
    if (const Stream* depth = frame->find(VFIT_STREAM_DEPTH)) {
        if (camera.width != depth->width || camera.height != depth->height)
            fail(VFIT_ERROR_ARGUMENT, "the intrinsics are for ", camera.width, " x ", camera.height,
                 ", the depth image has ", depth->width, " x ", depth->height);
        validate(camera);
    }
    find_floor(*frame);
    frame->time_ns = time_ns;
    for (Body& body : frame->bodies) {
        body = to_world(body, camera);
        if (body.time_ns == 0) body.time_ns = time_ns;
    }
    if (queue.push(std::move(frame)) != VFIT_OK) fail(VFIT_ERROR_STATE, "the stream is not running");
}

void SensorStream::find_floor(Frame& frame) {
    if (frame.camera.floor_state != VFIT_FLOOR_DEFAULT) return;
    std::lock_guard lock(floor_mutex_);
    if (!has_floor_ && !frame.bodies.empty()) {
        floor_ = Camera{};
        has_floor_ = estimate_floor(floor_, frame.bodies.front());
    }
    if (!has_floor_) return;
    frame.camera.floor_state = floor_.floor_state;
    frame.camera.floor_normal = floor_.floor_normal;
    frame.camera.floor_distance_m = floor_.floor_distance_m;
}

}  // namespace vfit
