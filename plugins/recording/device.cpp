#include "device.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/failure.h"

namespace recording {

using plugin::fail;

namespace {

void check(vfit_result result, const char* what, uint32_t frame) {
    if (result < 0) fail(result, "frame ", frame, ": the host refuses ", what, ", result ", result);
}

std::filesystem::path path_of(const std::string& uri) {
    const std::string scheme = "recording:";
    return uri.rfind(scheme, 0) == 0 ? uri.substr(scheme.size()) : uri;
}

}  // namespace

Device::Device(const vfit_host& host, void* stream, const std::string& uri)
    : host_(host),
      stream_(stream),
      folder_(open_folder(path_of(uri))),
      period_ns_(std::llround(1e9 / folder_.camera.fps)) {}

Device::~Device() { stop(); }

void Device::set_option(const std::string& key, const std::string& value) {
    if (thread_.joinable()) fail(VFIT_ERROR_STATE, "option ", key, ": stop the recording first");
    options_.set(key, value, folder_.frame_count);
}

bool Device::mode(uint32_t index, vfit_sensor_mode& out) const {
    if (index > 0) return false;
    out.width = folder_.camera.intrinsics.width;
    out.height = folder_.camera.intrinsics.height;
    out.rate_hz = static_cast<float>(folder_.camera.fps);
    std::snprintf(out.name, sizeof out.name, "%ux%u@%g", out.width, out.height, folder_.camera.fps);
    return true;
}

void Device::start() {
    stop();
    stopping_ = false;
    thread_ = std::thread([this] { run(); });
}

void Device::stop() {
    {
        std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
}

bool Device::stopping() {
    std::lock_guard lock(mutex_);
    return stopping_;
}

bool Device::wait_until(int64_t time_ns) {
    std::unique_lock lock(mutex_);
    const auto wait = std::chrono::nanoseconds(std::max<int64_t>(0, time_ns - host_.time_ns(host_.self)));
    wake_.wait_for(lock, wait, [&] { return stopping_; });
    return !stopping_;
}

void Device::run() {
    try {
        int64_t time_ns = host_.time_ns(host_.self);
        bool going = true;
        do {
            going = play(time_ns);
        } while (going && options_.loop);
        if (going) host_.stream_state(host_.self, stream_, VFIT_END_OF_STREAM, nullptr);
    } catch (const plugin::Failure& failure) {
        host_.stream_state(host_.self, stream_, failure.code(), failure.what());
    } catch (const std::bad_alloc&) {
        host_.stream_state(host_.self, stream_, VFIT_ERROR_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
        host_.stream_state(host_.self, stream_, VFIT_ERROR_UNKNOWN, error.what());
    }
}

bool Device::play(int64_t& time_ns) {
    if (folder_.joints) folder_.joints->rewind();
    if (folder_.timestamps) folder_.timestamps->rewind();
    if (folder_.contacts) folder_.contacts->rewind();
    first_ = true;
    const uint32_t rest = folder_.frame_count - options_.start;
    const uint32_t end = options_.start + (options_.count ? std::min(options_.count, rest) : rest);
    int64_t begin_ns = 0;
    for (uint32_t frame = options_.start; frame < end; ++frame) {
        const int64_t recorded_ns = recorded_time_ns(frame);
        if (frame == options_.start) begin_ns = recorded_ns;
        const int64_t due_ns = time_ns + (recorded_ns - begin_ns);
        if (stopping()) return false;
        // Where reading is slower than the camera was, frames are lost as a camera loses them.
        if (options_.realtime && host_.time_ns(host_.self) > due_ns + period_ns_) continue;
        const Outcome outcome = push(frame, due_ns);
        if (outcome == Outcome::stopping) return false;
        if (outcome == Outcome::dropped && !wait_until(due_ns)) return false;
    }
    time_ns += last_recorded_ns_ - begin_ns + period_ns_;
    return true;
}

int64_t Device::recorded_time_ns(uint32_t frame) {
    int64_t time_ns = first_ || !folder_.timestamps ? std::llround(frame * 1e9 / folder_.camera.fps)
                                                    : last_recorded_ns_ + period_ns_;
    if (folder_.timestamps) time_ns = folder_.timestamps->time_ns(frame).value_or(time_ns);
    // A row may come sooner than the period that filled a gap before it.
    if (!first_) time_ns = std::max(time_ns, last_recorded_ns_);
    first_ = false;
    last_recorded_ns_ = time_ns;
    return time_ns;
}

Device::Outcome Device::push(uint32_t frame, int64_t time_ns) {
    const vfit_intrinsics& in = folder_.camera.intrinsics;
    vfit_frame_layout layouts[3];
    uint32_t count = 0;
    const auto add = [&](vfit_stream stream, vfit_format format) {
        layouts[count++] = {sizeof(vfit_frame_layout), stream, format, in.width, in.height, 0};
    };
    add(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16);
    if (has_user_map()) add(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8);
    if (folder_.has_color) add(VFIT_STREAM_COLOR, VFIT_FORMAT_RGBA8);

    vfit_frame handle{};
    vfit_result result =
        host_.frame_begin(host_.self, stream_, layouts, sizeof(vfit_frame_layout), count, &handle);
    if (result == VFIT_ERROR_BUSY) return Outcome::dropped;
    if (result == VFIT_ERROR_STATE) return Outcome::stopping;
    check(result, "the frame's layout", frame);
    try {
        fill(handle, frame);
    } catch (...) {
        host_.frame_drop(host_.self, handle);
        throw;
    }
    if (options_.realtime && !wait_until(time_ns)) {
        host_.frame_drop(host_.self, handle);
        return Outcome::stopping;
    }
    result = host_.frame_push(host_.self, stream_, handle, time_ns);
    if (result == VFIT_ERROR_STATE) return Outcome::stopping;
    check(result, "the frame", frame);
    return Outcome::pushed;
}

void* Device::pixels(vfit_frame handle, vfit_stream kind, uint32_t& row_stride) const {
    void* out = nullptr;
    const vfit_result result = host_.frame_pixels(host_.self, handle, kind, &out, &row_stride);
    if (result != VFIT_OK) fail(result, "stream ", kind, ": the host gives no pixels, result ", result);
    return out;
}

namespace {

/// Left for right.
template <typename Pixel>
void mirror(void* pixels, const vfit_intrinsics& image, uint32_t row_stride) {
    for (uint32_t y = 0; y < image.height; ++y) {
        auto* row = reinterpret_cast<Pixel*>(static_cast<uint8_t*>(pixels) + size_t(y) * row_stride);
        std::reverse(row, row + image.width);
    }
}

}  // namespace

void Device::fill(vfit_frame handle, uint32_t frame) {
    const vfit_intrinsics& in = folder_.camera.intrinsics;
    uint32_t row_stride = 0;
    void* depth = pixels(handle, VFIT_STREAM_DEPTH, row_stride);
    png_.read_grey16(folder_.picture("depth", frame), in.width, in.height, depth, row_stride);
    if (folder_.camera.mirrored) mirror<uint16_t>(depth, in, row_stride);
    if (has_user_map()) fill_user_map(handle, frame);
    if (folder_.has_color) {
        void* color = pixels(handle, VFIT_STREAM_COLOR, row_stride);
        png_.read_rgba8(folder_.picture("color", frame), in.width, in.height, color, row_stride);
        if (folder_.camera.mirrored) mirror<uint32_t>(color, in, row_stride);
    }
    check(host_.frame_intrinsics(host_.self, handle, &in), "the intrinsics", frame);
    check(host_.frame_camera(host_.self, handle, &folder_.camera.camera), "the camera", frame);
    fill_bodies(handle, frame);
    fill_meta(handle, frame);
}

void Device::fill_user_map(vfit_frame handle, uint32_t frame) {
    const vfit_intrinsics& in = folder_.camera.intrinsics;
    uint32_t row_stride = 0, depth_stride = 0;
    auto* users = static_cast<uint8_t*>(pixels(handle, VFIT_STREAM_USER_MAP, row_stride));
    const auto* depth = static_cast<const uint8_t*>(pixels(handle, VFIT_STREAM_DEPTH, depth_stride));
    if (folder_.has_mask) {
        png_.read_grey8(folder_.picture("mask", frame), in.width, in.height, users, row_stride);
        if (folder_.camera.mirrored) mirror<uint8_t>(users, in, row_stride);
    }
    for (uint32_t y = 0; y < in.height; ++y) {
        uint8_t* row = users + size_t(y) * row_stride;
        const auto* depth_row = reinterpret_cast<const uint16_t*>(depth + size_t(y) * depth_stride);
        if (folder_.has_mask)
            std::replace(row, row + in.width, uint8_t(255), uint8_t(1));  // 255 is the person, id 1
        else
            for (uint32_t x = 0; x < in.width; ++x) row[x] = depth_row[x] > 0;
    }
}

void Device::fill_bodies(vfit_frame handle, uint32_t frame) {
    const size_t count = folder_.joints ? folder_.joints->bodies(frame, bodies_) : 0;
    for (size_t i = 0; i < count; ++i) {
        vfit_body body = vfit_body_init();
        body.body_id = bodies_[i].id;
        body.flags = VFIT_BODY_CAMERA_SPACE;
        const std::vector<vfit_joint>& joints = bodies_[i].joints;
        check(host_.frame_body(host_.self, handle, &body, joints.data(), sizeof(vfit_joint),
                               static_cast<uint32_t>(joints.size())),
              "a body", frame);
    }
}

void Device::fill_meta(vfit_frame handle, uint32_t frame) {
    char json[64];
    std::snprintf(json, sizeof json, "%u", frame);
    check(host_.frame_meta(host_.self, handle, "index", json), "its index", frame);
    if (folder_.joints) check(host_.frame_meta(host_.self, handle, "bodies", "true"), "its kind", frame);
    if (const auto contacts = folder_.contacts ? folder_.contacts->contacts(frame) : std::nullopt) {
        std::snprintf(json, sizeof json, "{\"left\": %d, \"right\": %d}", contacts->left, contacts->right);
        check(host_.frame_meta(host_.self, handle, "contacts", json), "its contacts", frame);
    }
    if (!folder_.measures.empty())
        check(host_.frame_meta(host_.self, handle, "measures", folder_.measures.c_str()), "its measures",
              frame);
}

}  // namespace recording
