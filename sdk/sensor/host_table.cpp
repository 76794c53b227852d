#include "sensor/host_table.h"

#include <algorithm>

#include "core/clock.h"
#include "core/error.h"
#include "core/handles.h"
#include "sensor/sized_struct.h"

namespace vfit {

namespace {

constexpr size_t kMaxSensors = 256;    // of one plug-in; more is a runaway report
constexpr size_t kMaxMessage = 1024;   // characters of a text by a plug-in that are kept
constexpr size_t kMaxComplaints = 16;  // log lines about one plug-in's misuse

}  // namespace

HostTable::HostTable(Log& log_to, std::function<uint64_t()> context_id)
    : log_(log_to), context_id_(std::move(context_id)) {
    table_.struct_size = sizeof(vfit_host);
    table_.abi_min = table_.abi_max = VFIT_PLUGIN_ABI;
    table_.self = this;
    table_.log = log;
    table_.sensor_added = sensor_added;
    table_.sensor_removed = sensor_removed;
    table_.frame_begin = frame_begin;
    table_.frame_pixels = frame_pixels;
    table_.frame_intrinsics = frame_intrinsics;
    table_.frame_camera = frame_camera;
    table_.frame_body = frame_body;
    table_.frame_meta = frame_meta;
    table_.frame_push = frame_push;
    table_.frame_drop = frame_drop;
    table_.stream_state = stream_state;
    table_.time_ns = time_ns;
}

HostTable::~HostTable() { retire(); }

void HostTable::set_name(const std::string& name) {
    std::lock_guard lock(mutex_);
    name_ = name;
}

void* HostTable::add_stream(Ref<SensorStream> stream) {
    std::lock_guard lock(mutex_);
    void* token = reinterpret_cast<void*>(next_token_++);
    streams_.push_back({token, std::move(stream)});
    return token;
}

void HostTable::remove_stream(void* token) {
    std::lock_guard lock(mutex_);
    std::erase_if(streams_, [&](const OpenStream& s) { return s.token == token; });
}

void HostTable::begin_discovery() {
    std::lock_guard lock(mutex_);
    for (KnownSensor& sensor : sensors_) sensor.fresh = false;
}

void HostTable::end_discovery(bool forget_others) {
    std::lock_guard lock(mutex_);
    if (forget_others) std::erase_if(sensors_, [](const KnownSensor& s) { return !s.fresh; });
}

std::vector<vfit_sensor_info> HostTable::sensors() const {
    std::lock_guard lock(mutex_);
    std::vector<vfit_sensor_info> out;
    for (const KnownSensor& sensor : sensors_) out.push_back(sensor.info);
    return out;
}

void HostTable::retire() {
    std::vector<OpenStream> streams;
    std::vector<Filling> unfinished;
    {
        std::lock_guard lock(mutex_);
        retired_ = true;
        streams.swap(streams_);
        unfinished.swap(filling_);
        sensors_.clear();
    }
    for (const OpenStream& s : streams) s.stream->queue.close();
    for (const Filling& f : unfinished) {
        try {
            Handles::instance().release(f.id, Kind::frame);
        } catch (const Error&) {
            // The context took the handle with it, or the plug-in released it by itself.
        }
    }
}

void HostTable::complain(const std::string& what) {
    std::string line;
    {
        std::lock_guard lock(mutex_);
        if (complaints_.size() == kMaxComplaints) return;
        if (std::find(complaints_.begin(), complaints_.end(), what) != complaints_.end()) return;
        complaints_.push_back(what);
        line = name_ + ": " + what;
        if (complaints_.size() == kMaxComplaints) line += " (what else it does wrong is not logged)";
    }
    log_.warning(line);
}

Ref<SensorStream> HostTable::stream(void* token) const {
    std::lock_guard lock(mutex_);
    for (const OpenStream& s : streams_)
        if (s.token == token) return s.stream;
    fail(VFIT_ERROR_HANDLE, "the stream is not one of an open device");
}

bool HostTable::is_open(void* token) const {
    return std::any_of(streams_.begin(), streams_.end(),
                       [&](const OpenStream& s) { return s.token == token; });
}

HostTable::Filling& HostTable::filling(vfit_frame frame) {
    for (Filling& f : filling_)
        if (f.id == frame.id) return f;
    fail(VFIT_ERROR_HANDLE, "the frame is not one that this plug-in is filling");
}

HostTable::Filling HostTable::take_filling(vfit_frame frame) {
    std::lock_guard lock(mutex_);
    Filling& place = filling(frame);
    Filling taken = std::move(place);
    if (&place != &filling_.back()) place = std::move(filling_.back());
    filling_.pop_back();
    return taken;
}

void HostTable::log(void* self, vfit_log_level level, const char* message) {
    enter(self, "log", [&](HostTable& t) {
        std::string line;
        {
            std::lock_guard lock(t.mutex_);
            if (t.retired_) return;
            line = t.name_ + ": " + bounded_text(message, kMaxMessage);
        }
        t.log_.write(std::clamp<vfit_log_level>(level, VFIT_LOG_ERROR, VFIT_LOG_DEBUG), line);
    });
}

void HostTable::sensor_added(void* self, const vfit_sensor_info* info) {
    enter(self, "sensor_added", [&](HostTable& t) {
        vfit_sensor_info in = read_sized(info, "info");
        end_text(in.uri);
        end_text(in.name);
        if (!in.uri[0]) fail(VFIT_ERROR_ARGUMENT, "a sensor without URI");
        in.struct_size = sizeof in;
        std::lock_guard lock(t.mutex_);
        if (t.retired_) return;
        std::memset(in.plugin, 0, sizeof in.plugin);
        t.name_.copy(in.plugin, sizeof in.plugin - 1);
        for (KnownSensor& known : t.sensors_)
            if (std::strcmp(known.info.uri, in.uri) == 0) {
                known = {in, true};
                return;
            }
        if (t.sensors_.size() < kMaxSensors) t.sensors_.push_back({in, true});
    });
}

void HostTable::sensor_removed(void* self, const char* uri) {
    enter(self, "sensor_removed", [&](HostTable& t) {
        const std::string gone = bounded_text(uri, sizeof vfit_sensor_info{}.uri);
        std::lock_guard lock(t.mutex_);
        std::erase_if(t.sensors_, [&](const KnownSensor& s) { return gone == s.info.uri; });
    });
}

int64_t HostTable::time_ns(void*) { return now_ns(); }

void HostTable::stream_state(void* self, void* token, vfit_result state, const char* message) {
    enter(self, "stream_state", [&](HostTable& t) {
        if (state > 0 && state != VFIT_END_OF_STREAM)
            fail(VFIT_ERROR_ARGUMENT, "state ", state, " is neither an error nor the end of the stream");
        std::string sentence = bounded_text(message, kMaxMessage);
        if (sentence.empty() && state < 0) sentence = text("the sensor's stream failed, error ", state);
        t.stream(token)->queue.set_state(state < VFIT_ERROR_PLUGIN ? VFIT_ERROR_PLUGIN : state, sentence);
    });
}

}  // namespace vfit
