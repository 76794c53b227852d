#include "device.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "error.h"

namespace vfit::virtual_person {

namespace {

constexpr std::chrono::milliseconds kNap{2};  // between looks at the clock, so that a stop is noticed

}  // namespace

void Device::discover(const vfit_host& host) {
    vfit_sensor_info info = vfit_sensor_info_init();
    std::snprintf(info.uri, sizeof info.uri, "virtual:");
    std::snprintf(info.name, sizeof info.name, "Virtual person");
    std::snprintf(info.plugin, sizeof info.plugin, "%s", kName);
    host.sensor_added(host.self, &info);
}

Device::Device(const vfit_host& host, void* stream, const std::string&)
    : host_(&host), stream_(stream), shape_keys_(shape_list(context_.get())) {}

void Device::set_option(const std::string& key, const std::string& value) {
    if (thread_.joinable())
        fail(VFIT_ERROR_STATE, "virtual: option ", key, " cannot change while the stream runs");
    if (options_.set(key, value)) return;
    for (const vfit_shape_value& shape : shape_keys_) {
        if (key != shape.key) continue;
        if (value.empty())
            shape_.erase(key);
        else
            shape_[key] = static_cast<float>(parse_number(key, value, shape.minimum, shape.maximum));
        return;
    }
    fail(VFIT_ERROR_ARGUMENT, "virtual: unknown option '", key, "'; known are ", Options::names(),
         " and the shape keys of vfit_shape_list (weight, height, ...)");
}

bool Device::mode(uint32_t index, vfit_sensor_mode& out) const {
    if (index >= sensor_model_count()) return false;
    const SensorModel& model = sensor_model(index);
    out = vfit_sensor_mode_init();
    out.width = model.width, out.height = model.height;
    out.rate_hz = static_cast<float>(options_.number("rate"));
    std::snprintf(out.name, sizeof out.name, "%s", model.name);
    return true;
}

bool Device::option(uint32_t index, vfit_sensor_option& out) const {
    out = vfit_sensor_option_init();
    if (index < options_.count()) {
        options_.describe(index, out);
        return true;
    }
    index -= options_.count();
    if (index >= shape_keys_.size()) return false;
    const vfit_shape_value& shape = shape_keys_[index];
    std::snprintf(out.key, sizeof out.key, "%.31s", shape.key);
    if (const auto set = shape_.find(shape.key); set != shape_.end())
        std::snprintf(out.value, sizeof out.value, "%g", double{set->second});
    std::snprintf(out.text, sizeof out.text, "Shape of the body, %g to %g; empty: that of the default body",
                  double{shape.minimum}, double{shape.maximum});
    return true;
}

void Device::start() {
    if (thread_.joinable()) fail(VFIT_ERROR_STATE, "virtual: the stream runs already");
    renderer_ = std::make_unique<Renderer>(context_.get(), options_, shape_);
    stopping_ = false;
    thread_ = std::thread([this] { run(); });
}

void Device::stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
    renderer_.reset();
}

void Device::run() {
    vfit_result result = VFIT_OK;
    std::string message;
    try {
        const uint64_t frames = options_.whole("frames");
        const double frame_time_ns = 1e9 / options_.number("rate");
        const bool realtime = options_.text("pace") == "realtime";
        const int64_t begin_ns = host_->time_ns(host_->self);
        for (uint64_t i = 0; result == VFIT_OK && !stopping_; ++i) {
            // Where a frame takes longer than a camera's, frames are lost as a camera loses them: otherwise
            // the person would fall behind the clock for ever.
            if (realtime)
                i = std::max(
                    i, static_cast<uint64_t>(static_cast<double>(host_->time_ns(host_->self) - begin_ns) /
                                             frame_time_ns));
            if (frames != 0 && i >= frames) {
                result = VFIT_END_OF_STREAM;
                break;
            }
            const int64_t time_ns = begin_ns + static_cast<int64_t>(static_cast<double>(i) * frame_time_ns);
            if (realtime) wait_until(time_ns);
            result = push_frame(i, time_ns);
        }
    } catch (const Error& e) {
        result = e.code(), message = e.what();
    } catch (const std::exception& e) {
        result = VFIT_ERROR_UNKNOWN, message = std::string("virtual: ") + e.what();
    }
    // A push refused because the stream stops is how stopping looks from here, not news.
    if (stopping_ || result == VFIT_ERROR_STATE) return;
    if (result < 0 && message.empty()) message = "virtual: the host refused a frame";
    host_->stream_state(host_->self, stream_, result, message.c_str());
}

void Device::wait_until(int64_t time_ns) const {
    while (!stopping_ && host_->time_ns(host_->self) < time_ns) std::this_thread::sleep_for(kNap);
}

vfit_result Device::push_frame(uint64_t index, int64_t time_ns) {
    Renderer& r = *renderer_;
    r.advance(index);

    const auto layout = [&](vfit_stream stream, vfit_format format) {
        vfit_frame_layout l = vfit_frame_layout_init();
        l.stream = stream, l.format = format;
        l.width = r.model().width, l.height = r.model().height;
        return l;
    };
    const vfit_frame_layout layouts[] = {layout(VFIT_STREAM_DEPTH, VFIT_FORMAT_U16),
                                         layout(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8)};
    void* const self = host_->self;
    vfit_frame frame{};
    const vfit_result begun = host_->frame_begin(self, stream_, layouts, sizeof layouts[0], 2, &frame);
    if (begun == VFIT_ERROR_BUSY)
        return VFIT_OK;  // the reader holds every frame of the pool: this one is lost
    if (begun < 0) return begun;
    try {
        const auto need = [](vfit_result result, const char* what) {
            if (result < 0) fail(result, "virtual: the host took no ", what);
        };
        void* pixels = nullptr;
        uint32_t row_stride = 0;
        need(host_->frame_pixels(self, frame, VFIT_STREAM_DEPTH, &pixels, &row_stride), "depth");
        r.write_depth(static_cast<uint16_t*>(pixels), row_stride);
        need(host_->frame_pixels(self, frame, VFIT_STREAM_USER_MAP, &pixels, &row_stride), "user map");
        r.write_user_map(static_cast<uint8_t*>(pixels), row_stride);
        need(host_->frame_intrinsics(self, frame, &r.intrinsics()), "intrinsics");
        need(host_->frame_camera(self, frame, &r.camera()), "camera");

        for (const SeenBody& seen : r.bodies()) {
            vfit_body body = vfit_body_init();
            body.body_id = seen.id, body.time_ns = time_ns, body.flags = seen.flags;
            need(host_->frame_body(self, frame, &body, seen.joints.data(), sizeof(vfit_joint),
                                   static_cast<uint32_t>(seen.joints.size())),
                 "body");
        }
        need(host_->frame_meta(self, frame, "bodies", "true"),
             "kind");  // nobody in view is an answer as well
        if (r.has_person()) {
            need(host_->frame_meta(self, frame, "contacts", r.contacts_json()), "contacts");
            need(host_->frame_meta(self, frame, "measures", r.measures_json().c_str()), "measures");
        }
        need(host_->frame_meta(self, frame, "index", std::to_string(index).c_str()), "index");
    } catch (...) {
        host_->frame_drop(self, frame);
        throw;
    }
    return host_->frame_push(self, stream_, frame, time_ns);
}

}  // namespace vfit::virtual_person
