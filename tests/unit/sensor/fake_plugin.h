// A plug-in that lives in the test: well-behaved unless a test changes its table or its behaviour.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "sensor/plugin_host.h"

namespace vfit::test {

struct FakePlugin {
    const vfit_host* host = nullptr;
    void* stream = nullptr;  // of the device that was opened last
    vfit_plugin table{};
    vfit_result negotiated = VFIT_OK;
    std::string error = "the fake device is unplugged";
    std::string pace = "none";  // of the option list; empty: not listed
    std::vector<std::string> calls;
    std::vector<std::pair<std::string, std::string>> set;
    vfit_result open_result = VFIT_OK;
    vfit_result start_result = VFIT_OK;
    std::function<void()> on_discover = [] {};

    FakePlugin() {
        current() = this;
        table.struct_size = sizeof table;
        table.abi = VFIT_PLUGIN_ABI;
        table.version = 7;
        table.name = "fake";
        table.schemes = "fake,spare";
        table.self = this;
        table.last_error = [](void* self) { return of(self).error.c_str(); };
        table.discover = [](void* self) -> vfit_result {
            of(self).on_discover();
            return VFIT_OK;
        };
        table.open = [](void* self, const char* uri, void* stream, void** device) {
            of(self).calls.push_back(std::string("open ") + uri);
            of(self).stream = stream;
            if (of(self).open_result == VFIT_OK) *device = self;
            return of(self).open_result;
        };
        table.set_option = [](void* self, const char* key, const char* value) -> vfit_result {
            of(self).set.emplace_back(key, value);
            const std::string name = key;
            return name == "gain" || name == "pace" ? VFIT_OK : VFIT_ERROR_UNSUPPORTED;
        };
        table.mode = [](void*, uint32_t index, vfit_sensor_mode* out) -> vfit_result {
            if (index > 0) return VFIT_END_OF_STREAM;
            out->width = 4;
            out->height = 2;
            out->rate_hz = 30.0f;
            std::string("small").copy(out->name, sizeof out->name);
            return VFIT_OK;
        };
        table.option = [](void* self, uint32_t index, vfit_sensor_option* out) -> vfit_result {
            if (index > 0 || of(self).pace.empty()) return VFIT_END_OF_STREAM;
            std::string("pace").copy(out->key, sizeof out->key);
            of(self).pace.copy(out->value, sizeof out->value);
            return VFIT_OK;
        };
        table.start = [](void* self) {
            of(self).calls.push_back("start");
            return of(self).start_result;
        };
        table.stop = [](void* self) -> vfit_result {
            of(self).calls.push_back("stop");
            return VFIT_OK;
        };
        table.close = [](void* self) { of(self).calls.push_back("close"); };
        table.shutdown = [](void* self) { of(self).calls.push_back("shutdown"); };
    }

    static FakePlugin*& current() {
        static FakePlugin* plugin = nullptr;
        return plugin;
    }
    static FakePlugin& of(void* self) { return *static_cast<FakePlugin*>(self); }
    static vfit_result negotiate(const vfit_host* host, vfit_plugin* out) {
        current()->host = host;
        *out = current()->table;
        return current()->negotiated;
    }

    vfit_result begin(vfit_frame& frame, uint32_t width = 4, uint32_t height = 2) const {
        const vfit_frame_layout layout{sizeof layout, VFIT_STREAM_DEPTH, VFIT_FORMAT_U16, width, height, 0};
        return host->frame_begin(host->self, stream, &layout, sizeof layout, 1, &frame);
    }
    vfit_result set_intrinsics(vfit_frame frame, uint32_t width = 4, uint32_t height = 2) const {
        vfit_intrinsics in = vfit_intrinsics_init();
        in.width = width;
        in.height = height;
        in.fx = in.fy = 4.0f;
        in.cx = 1.5f;
        in.cy = 0.5f;
        return host->frame_intrinsics(host->self, frame, &in);
    }
    vfit_result push(vfit_frame frame, int64_t time_ns = 0) const {
        return host->frame_push(host->self, stream, frame, time_ns);
    }
    /// A whole frame whose first pixel is `depth`.
    vfit_result push_frame(uint16_t depth) const {
        vfit_frame frame{};
        if (const vfit_result result = begin(frame); result != VFIT_OK) return result;
        void* pixels = nullptr;
        host->frame_pixels(host->self, frame, VFIT_STREAM_DEPTH, &pixels, nullptr);
        static_cast<uint16_t*>(pixels)[0] = depth;
        set_intrinsics(frame);
        return push(frame);
    }
    vfit_result add_joint(vfit_frame frame, vfit_joint_id id, float x, float y, float z,
                          uint32_t body_id = 1) const {
        vfit_body body = vfit_body_init();
        body.body_id = body_id;
        vfit_joint joint = vfit_joint_init();
        joint.joint = id;
        joint.state = VFIT_JOINT_MEASURED;
        joint.confidence = 1.0f;
        joint.position[0] = x;
        joint.position[1] = y;
        joint.position[2] = z;
        return host->frame_body(host->self, frame, &body, &joint, sizeof joint, 1);
    }
    void end_stream(vfit_result state, const char* message = nullptr) const {
        host->stream_state(host->self, stream, state, message);
    }
};

/// A host with one fake plug-in; log lines are kept and not printed.
struct FakeHost {
    std::mutex lines_mutex;
    std::vector<std::string> lines;
    Log log{[](void* user, vfit_log_level, const char* message) {
                auto& self = *static_cast<FakeHost*>(user);
                std::lock_guard lock(self.lines_mutex);
                self.lines.emplace_back(message);
            },
            this};
    FakePlugin plugin;
    PluginHost host{log, [] { return uint64_t(0); }};

    void attach() { host.attach("fake.so", FakePlugin::negotiate); }
    Ref<Sensor> open_and_start() {
        attach();
        Ref<Sensor> sensor = host.open("fake:1");
        sensor->start();
        return sensor;
    }
    size_t lines_with(const std::string& part) const {
        size_t count = 0;
        for (const std::string& line : lines) count += line.find(part) != std::string::npos;
        return count;
    }
};

/// Code and sentence of what an action fails with; code VFIT_OK where it does not.
struct Failure {
    vfit_result code = VFIT_OK;
    std::string message;
    bool says(const std::string& part) const { return message.find(part) != std::string::npos; }
};

template <typename Action>
Failure failure_of(Action&& action) {
    try {
        action();
    } catch (const Error& error) {
        return {error.code(), error.what()};
    }
    return {};
}

}  // namespace vfit::test
