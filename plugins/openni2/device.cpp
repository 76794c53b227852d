#include "device.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "support/failure.h"

namespace openni2 {

using plugin::fail;

namespace {

constexpr char kDevices[] = "openni2:", kFiles[] = "oni:";
// The reader says itself that nothing comes; one that does not even do that hangs in the library.
constexpr int kOpens_ms = 20000, kPatience_ms = 8000;
constexpr int kAgain_ms = 250;  // between tries to find a lost device
// Time stamps of a damaged file may be anything.
constexpr int64_t kLongestGap_us = 1000000;

std::string strip(const std::string& uri, const char* scheme) {
    const std::string start(scheme);
    return uri.rfind(start, 0) == 0 ? uri.substr(start.size()) : uri;
}

vfit_result result_of(Ending ending, bool is_file) {
    switch (ending) {
        case Ending::end: return VFIT_END_OF_STREAM;
        case Ending::lost: return VFIT_ERROR_DEVICE_LOST;
        case Ending::damaged: return VFIT_ERROR_DATA;
        case Ending::unsupported: return VFIT_ERROR_UNSUPPORTED;
        case Ending::no_library: return VFIT_ERROR_PLUGIN;
        case Ending::no_device:
        case Ending::failed: return is_file ? VFIT_ERROR_DATA : VFIT_ERROR_IO;
    }
    return VFIT_ERROR_UNKNOWN;
}

template <typename T>
T receive(const ReaderProcess& reader, const Head& head, int patience_ms) {
    T what{};
    if (head.bytes != sizeof what) throw Broken("it sent a message of another size");
    reader.socket().receive(&what, sizeof what, patience_ms);
    return what;
}

State state_of(const ReaderProcess& reader, const Head& head) {
    State state = receive<State>(reader, head, kPatience_ms);
    state.text[sizeof state.text - 1] = 0;
    return state;
}

bool is_mode(const Mode& mode) {
    return mode.width >= 1 && mode.height >= 1 && mode.width <= kMostPixels && mode.height <= kMostPixels &&
           std::isfinite(mode.rate_hz);
}

bool is_fov(float angle_rad) { return angle_rad > 0.05f && angle_rad < 3.0f; }

}  // namespace

void Device::discover(const vfit_host& host) {
    ReaderProcess reader({"list"});
    try {
        for (;;) {
            const Head head = reader.socket().receive_head(kOpens_ms);
            if (head.kind == Kind::list_end) return;
            if (head.kind == Kind::state) {
                const State state = state_of(reader, head);
                // Who has no such camera need not have the library.
                if (state.ending == Ending::no_library) return host.log(host.self, VFIT_LOG_INFO, state.text);
                fail(VFIT_ERROR_IO, state.text);
            }
            if (head.kind != Kind::listed) throw Broken("it sent something else");
            Listed listed = receive<Listed>(reader, head, kPatience_ms);
            listed.uri[sizeof listed.uri - 1] = listed.name[sizeof listed.name - 1] = 0;
            vfit_sensor_info info = vfit_sensor_info_init();
            std::snprintf(info.uri, sizeof info.uri, "%s", listed.uri);
            std::snprintf(info.name, sizeof info.name, "%s", listed.name);
            std::snprintf(info.plugin, sizeof info.plugin, "%s", kName);
            host.sensor_added(host.self, &info);
        }
    } catch (const Broken& broken) {
        fail(VFIT_ERROR_PLUGIN, "openni2: listing devices: ", broken.what(), "; the reader ", reader.end());
    }
}

Device::Device(const vfit_host& host, void* stream, const std::string& uri)
    : host_(host),
      stream_(stream),
      uri_(uri),
      opens_(strip(strip(uri, kFiles), kDevices)),
      is_file_(uri.rfind(kFiles, 0) == 0) {
    std::error_code ignored;
    if (is_file_ && !std::filesystem::is_regular_file(opens_, ignored))
        fail(VFIT_ERROR_IO, opens_, ": there is no such file");
    reader_ = std::make_unique<ReaderProcess>(std::vector<std::string>{"open", opens_});
    const Opened opened = wait_for_opened(*reader_);
    is_file_ = is_file_ || opened.is_file;
    options_ = Options(opened);
    clean_ = true;
}

Device::~Device() { stop(); }

Opened Device::wait_for_opened(ReaderProcess& reader) const {
    try {
        const Head head = reader.socket().receive_head(kOpens_ms);
        if (head.kind == Kind::state) {
            const State state = state_of(reader, head);
            fail(result_of(state.ending, is_file_), state.text);
        }
        if (head.kind != Kind::opened) throw Broken("it sent something else");
        Opened opened = receive<Opened>(reader, head, kPatience_ms);
        if (opened.mode_count == 0 || opened.mode_count > kMostModes || opened.mode >= opened.mode_count ||
            !std::all_of(opened.modes, opened.modes + opened.mode_count, is_mode))
            throw Broken("it tells modes that cannot be");
        return opened;
    } catch (const Broken& broken) {
        if (is_file_)
            fail(VFIT_ERROR_DATA, opens_, ": is damaged: its reader ", reader.end(), " while it opened it");
        fail(VFIT_ERROR_PLUGIN, uri_, ": opening it: ", broken.what(), "; the reader ", reader.end());
    }
}

void Device::set_option(const std::string& key, const std::string& value) {
    if (thread_.joinable()) fail(VFIT_ERROR_STATE, "option ", key, ": stop the sensor first");
    options_.set(key, value);
}

void Device::start() {
    stop();
    if (!reader_) {
        auto reader = std::make_unique<ReaderProcess>(std::vector<std::string>{"open", opens_});
        wait_for_opened(*reader);
        reader_ = std::move(reader);
    }
    stopping_ = opening_ = false;
    clean_ = false;
    first_ = true;
    last_ns_ = host_.time_ns(host_.self);
    try {
        reader_->socket().send(Kind::start, options_.start());
    } catch (const Broken& broken) {
        const std::string end = reader_->end();
        reader_.reset();
        fail(VFIT_ERROR_PLUGIN, uri_, ": starting it: ", broken.what(), "; the reader ", end);
    }
    thread_ = std::thread([this] { run(); });
}

void Device::stop() {
    if (!thread_.joinable()) return;
    {
        std::lock_guard lock(mutex_);
        stopping_ = true;
        try {
            if (opening_)
                reader_->socket().interrupt();
            else if (reader_)
                reader_->socket().send(Kind::stop);
        } catch (const Broken&) {
            // The thread finds that out as well.
        }
    }
    wake_.notify_all();
    thread_.join();
    // A file would go on where it stopped: seeking in it crashes OpenNI2, so it is opened again.
    if (!clean_ || is_file_) reader_.reset();
}

bool Device::stopping() {
    std::lock_guard lock(mutex_);
    return stopping_;
}

bool Device::pause(int milliseconds) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, std::chrono::milliseconds(milliseconds), [&] { return stopping_; });
    return !stopping_;
}

bool Device::wait_until(int64_t time_ns) {
    std::unique_lock lock(mutex_);
    const auto wait = std::chrono::nanoseconds(std::max<int64_t>(0, time_ns - host_.time_ns(host_.self)));
    wake_.wait_for(lock, wait, [&] { return stopping_; });
    return !stopping_;
}

void Device::tell(vfit_result state, const std::string& message) const {
    host_.stream_state(host_.self, stream_, state, message.c_str());
}

void Device::run() {
    try {
        for (;;) {
            const Outcome outcome = play();
            if (outcome == Outcome::stopping) return;
            if (outcome == Outcome::ended && !(options_.loop() && is_file_))
                return tell(VFIT_END_OF_STREAM, "");
            if (!come_back()) return;
            if (outcome == Outcome::lost) tell(VFIT_OK, "");
        }
    } catch (const plugin::Failure& failure) {
        tell(failure.code(), failure.what());
    } catch (const std::bad_alloc&) {
        tell(VFIT_ERROR_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& error) {
        tell(VFIT_ERROR_UNKNOWN, error.what());
    }
}

Device::Outcome Device::play() {
    try {
        for (;;) {
            const Head head = reader_->socket().receive_head(kPatience_ms);
            Outcome outcome = Outcome::goes_on;
            if (head.kind == Kind::stopped)
                clean_ = true, outcome = Outcome::stopping;
            else if (head.kind == Kind::state)
                outcome = take_state(head);
            else if (head.kind == Kind::image)
                outcome = take_image(head);
            else
                throw Broken("it sent something else");
            if (outcome != Outcome::goes_on) return outcome;
        }
    } catch (const Broken&) {
        return broken();
    }
}

Device::Outcome Device::broken() {
    const std::string end = reader_->end();
    if (stopping()) return Outcome::stopping;
    if (is_file_) fail(VFIT_ERROR_DATA, opens_, ": is damaged: its reader ", end);
    tell(VFIT_ERROR_DEVICE_LOST, uri_ + ": its driver " + end);
    return Outcome::lost;
}

Device::Outcome Device::take_state(const Head& head) {
    const State state = state_of(*reader_, head);
    if (state.ending == Ending::end) return Outcome::ended;
    if (state.ending != Ending::lost) fail(result_of(state.ending, is_file_), state.text);
    tell(VFIT_ERROR_DEVICE_LOST, state.text);
    return Outcome::lost;
}

/// A reader anew: of a file from its begin, of a device once it is there again. False: the stream stops.
bool Device::come_back() {
    const auto replace = [&](std::unique_ptr<ReaderProcess> reader) {
        std::unique_ptr<ReaderProcess> old;  // which ends without the lock
        std::lock_guard lock(mutex_);
        old = std::exchange(reader_, std::move(reader));
        opening_ = reader_ != nullptr;
        return !stopping_;
    };
    first_ = true;
    for (;;) {
        replace(nullptr);
        if (!is_file_ && !pause(kAgain_ms)) return false;
        try {
            if (!replace(std::make_unique<ReaderProcess>(std::vector<std::string>{"open", opens_})))
                return false;
            wait_for_opened(*reader_);
            reader_->socket().send(Kind::start, options_.start());
            std::lock_guard lock(mutex_);
            opening_ = false;
            return !stopping_;
        } catch (const plugin::Failure&) {
            if (is_file_) throw;
        } catch (const Broken&) {
            if (is_file_) fail(VFIT_ERROR_DATA, opens_, ": cannot be read again");
        }
    }
}

void Device::skip(size_t bytes) {
    skipped_.resize(1 << 16);
    for (size_t part; bytes > 0; bytes -= part) {
        part = std::min(bytes, skipped_.size());
        reader_->socket().receive(skipped_.data(), part, kPatience_ms);
    }
}

/// When the image was taken, or is to be shown.
int64_t Device::time_of(const Image& image) {
    if (!is_file_) return host_.time_ns(host_.self);
    const int64_t gap_us =
        first_ ? std::llround(1e6 / std::max(options_.mode().rate_hz, 1.0f)) : image.time_us - last_us_;
    last_us_ = image.time_us;
    first_ = false;
    return last_ns_ += 1000 * std::clamp<int64_t>(gap_us, 0, kLongestGap_us);
}

Device::Outcome Device::take_image(const Head& head) {
    Image image{};
    if (head.bytes < sizeof image) throw Broken("it sent a message of another size");
    reader_->socket().receive(&image, sizeof image, kPatience_ms);
    const Mode& mode = options_.mode();
    const size_t pixels = size_t(mode.width) * mode.height, bytes = head.bytes - sizeof image;
    if (image.width != mode.width || image.height != mode.height ||
        bytes != pixels * (image.has_color ? 6u : 2u) || image.has_color > 1)
        throw Broken("it sent an image of another size");
    if (!is_fov(image.horizontal_fov_rad) || !is_fov(image.vertical_fov_rad))
        fail(is_file_ ? VFIT_ERROR_DATA : VFIT_ERROR_UNSUPPORTED, opens_, ": its field of view, ",
             image.horizontal_fov_rad, " x ", image.vertical_fov_rad, " rad, cannot be");
    const int64_t time_ns = time_of(image);
    // Where reading is slower than the camera was, frames are lost as a camera loses them.
    const int64_t period_ns = std::llround(1e9 / std::max(mode.rate_hz, 1.0f));
    const bool late = is_file_ && options_.realtime() && host_.time_ns(host_.self) > time_ns + period_ns;
    if (late || stopping()) return skip(bytes), Outcome::goes_on;

    vfit_frame_layout layouts[2] = {
        {sizeof(vfit_frame_layout), VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, mode.width, mode.height, 0},
        {sizeof(vfit_frame_layout), VFIT_STREAM_COLOR, VFIT_FORMAT_RGBA8, mode.width, mode.height, 0}};
    vfit_frame frame{};
    const vfit_result begun =
        host_.frame_begin(host_.self, stream_, layouts, sizeof layouts[0], image.has_color ? 2 : 1, &frame);
    if (begun == VFIT_ERROR_BUSY || begun == VFIT_ERROR_STATE) return skip(bytes), Outcome::goes_on;
    if (begun < 0) fail(begun, opens_, ": the host refuses the frame's layout, result ", begun);
    try {
        fill(frame, image);
    } catch (...) {
        host_.frame_drop(host_.self, frame);
        throw;
    }
    if (is_file_ && options_.realtime() && !wait_until(time_ns)) {
        host_.frame_drop(host_.self, frame);
        return Outcome::goes_on;
    }
    const vfit_result pushed = host_.frame_push(host_.self, stream_, frame, time_ns);
    if (pushed < 0 && pushed != VFIT_ERROR_STATE)
        fail(pushed, opens_, ": the host refuses the frame, result ", pushed);
    return Outcome::goes_on;
}

void Device::fill(vfit_frame frame, const Image& image) const {
    const auto check = [&](vfit_result result, const char* what) {
        if (result < 0) fail(result, opens_, ": the host refuses ", what, ", result ", result);
    };
    const auto receive_rows = [&](vfit_stream stream, size_t row_bytes) {
        void* pixels = nullptr;
        uint32_t stride = 0;
        check(host_.frame_pixels(host_.self, frame, stream, &pixels, &stride), "pixels");
        for (uint32_t y = 0; y < image.height; ++y)
            reader_->socket().receive(static_cast<uint8_t*>(pixels) + size_t(y) * stride, row_bytes,
                                      kPatience_ms);
    };
    receive_rows(VFIT_STREAM_DEPTH, size_t(image.width) * 2);
    if (image.has_color) receive_rows(VFIT_STREAM_COLOR, size_t(image.width) * 4);
    vfit_intrinsics intrinsics = vfit_intrinsics_init();
    intrinsics.width = image.width, intrinsics.height = image.height;
    // As OpenNI2's own conversion to world space: the middle of the image lies between pixels.
    intrinsics.cx = 0.5f * float(image.width), intrinsics.cy = 0.5f * float(image.height);
    intrinsics.fx = intrinsics.cx / std::tan(0.5f * image.horizontal_fov_rad);
    intrinsics.fy = intrinsics.cy / std::tan(0.5f * image.vertical_fov_rad);
    check(host_.frame_intrinsics(host_.self, frame, &intrinsics), "the intrinsics");
    vfit_camera camera = vfit_camera_init();
    camera.depth_unit_m = image.depth_unit_m;
    check(host_.frame_camera(host_.self, frame, &camera), "the camera");
    check(host_.frame_meta(host_.self, frame, "index", std::to_string(image.index).c_str()), "its index");
}

}  // namespace openni2
