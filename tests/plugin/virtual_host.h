// A host of the tests' own for the virtual person: takes every frame that the plug-in pushes.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "sensor/source_uri.h"
#include "types.h"
#include "vfit_plugin.h"

namespace vfit::virtual_person {

struct Taken {
    uint32_t width = 0, height = 0;
    std::vector<uint16_t> depth;
    std::vector<uint8_t> user;
    vfit_intrinsics intrinsics{};
    vfit_camera camera{};
    vfit_body body{};  // the first, with its joints
    std::vector<vfit_joint> joints;
    std::map<uint32_t, std::vector<vfit_joint>> everybody;  // by id
    std::map<std::string, std::string> meta;
    int64_t time_ns = 0;

    Vec3 unproject(uint32_t x, uint32_t y) const {
        const float z = depth[size_t{y} * width + x] * camera.depth_unit_m;
        return {(float(x) - intrinsics.cx) / intrinsics.fx * z,
                (float(y) - intrinsics.cy) / intrinsics.fy * z, z};
    }
    size_t pixels_of(uint8_t id) const { return size_t(std::count(user.begin(), user.end(), id)); }
    Vec2 project(const vfit_joint& j) const {
        return {j.position[0] / j.position[2] * intrinsics.fx + intrinsics.cx,
                j.position[1] / j.position[2] * intrinsics.fy + intrinsics.cy};
    }
};

// The host's side of vfit_plugin.h; keeps every frame that is pushed.
class TestHost {
public:
    TestHost() {
        host_.struct_size = sizeof host_;
        host_.abi_min = host_.abi_max = VFIT_PLUGIN_ABI;
        host_.self = this;
        host_.log = [](void*, vfit_log_level, const char*) {};
        host_.sensor_added = [](void* self, const vfit_sensor_info* info) {
            me(self).found.push_back(*info);
        };
        host_.sensor_removed = [](void*, const char*) {};
        host_.frame_begin = [](void* self, void*, const vfit_frame_layout* layouts, uint32_t, uint32_t count,
                               vfit_frame* out) {
            Taken& f = me(self).filling;
            f = {};
            f.width = layouts[0].width, f.height = layouts[0].height;
            EXPECT_EQ(count, 2u);
            f.depth.resize(size_t{f.width} * f.height), f.user.resize(f.depth.size());
            out->id = 1;
            return vfit_result{VFIT_OK};
        };
        host_.frame_pixels = [](void* self, vfit_frame, vfit_stream kind, void** pixels,
                                uint32_t* row_stride) {
            Taken& f = me(self).filling;
            const bool depth = kind == VFIT_STREAM_DEPTH;
            *pixels = depth ? static_cast<void*>(f.depth.data()) : f.user.data();
            *row_stride = f.width * (depth ? 2 : 1);
            return vfit_result{VFIT_OK};
        };
        host_.frame_intrinsics = [](void* self, vfit_frame, const vfit_intrinsics* in) {
            me(self).filling.intrinsics = *in;
            return vfit_result{VFIT_OK};
        };
        host_.frame_camera = [](void* self, vfit_frame, const vfit_camera* in) {
            me(self).filling.camera = *in;
            return vfit_result{VFIT_OK};
        };
        host_.frame_body = [](void* self, vfit_frame, const vfit_body* body, const vfit_joint* items,
                              uint32_t, uint32_t count) {
            Taken& f = me(self).filling;
            if (f.everybody.empty()) f.body = *body, f.joints.assign(items, items + count);
            f.everybody[body->body_id].assign(items, items + count);
            return vfit_result{VFIT_OK};
        };
        host_.frame_meta = [](void* self, vfit_frame, const char* key, const char* json) {
            me(self).filling.meta[key] = json;
            return vfit_result{VFIT_OK};
        };
        host_.frame_push = [](void* self, void*, vfit_frame, int64_t time_ns) {
            TestHost& h = me(self);
            h.filling.time_ns = time_ns;
            std::lock_guard lock(h.mutex);
            h.frames.push_back(std::move(h.filling));
            h.changed.notify_all();
            return vfit_result{h.frames.size() < h.capacity ? VFIT_OK : VFIT_ERROR_STATE};
        };
        host_.frame_drop = [](void*, vfit_frame) {};
        host_.stream_state = [](void* self, void*, vfit_result state, const char* message) {
            TestHost& h = me(self);
            std::lock_guard lock(h.mutex);
            h.state = state, h.message = message;
            h.changed.notify_all();
        };
        host_.time_ns = [](void* self) {
            TestHost& h = me(self);
            return h.now_ns += h.tick_ns;
        };
        plugin.struct_size = sizeof plugin;
        EXPECT_EQ(vfit_plugin_negotiate(&host_, &plugin), VFIT_OK);
    }
    ~TestHost() { plugin.shutdown(plugin.self); }

    /// Opens a device and sets the options of the URI, as the host of libvfit does. `device` is null where
    /// the result is an error.
    vfit_result open(const std::string& uri, void*& device) {
        const SourceUri source = parse_source_uri(uri, !(plugin.caps & VFIT_PLUGIN_NO_ADDRESS));
        device = nullptr;
        vfit_result result = plugin.open(plugin.self, source.device().c_str(), this, &device);
        for (const SourceOption& option : source.options)
            if (result == VFIT_OK)
                result = plugin.set_option(device, option.key.c_str(), option.value.c_str());
        if (result != VFIT_OK && device) plugin.close(std::exchange(device, nullptr));
        return result;
    }

    /// Frames of one whole stream.
    std::vector<Taken> run(const std::string& uri) {
        frames.clear();
        state = VFIT_OK;
        void* device = nullptr;
        EXPECT_EQ(open(uri, device), VFIT_OK) << plugin.last_error(plugin.self);
        if (!device) return {};
        EXPECT_EQ(plugin.start(device), VFIT_OK) << plugin.last_error(plugin.self);
        {
            std::unique_lock lock(mutex);
            EXPECT_TRUE(changed.wait_for(lock, std::chrono::seconds(60),
                                         [&] { return state != VFIT_OK || frames.size() >= capacity; }));
        }
        EXPECT_TRUE(state == VFIT_END_OF_STREAM || frames.size() >= capacity) << message;
        EXPECT_EQ(plugin.stop(device), VFIT_OK);
        plugin.close(device);
        return std::move(frames);
    }

    vfit_plugin plugin{};
    std::vector<vfit_sensor_info> found;
    std::vector<Taken> frames;
    Taken filling;
    size_t capacity = 1000;
    std::atomic<int64_t> now_ns{1'000'000'000};
    int64_t tick_ns = 0;  // that the clock goes on each time it is read
    vfit_result state = VFIT_OK;
    std::string message;

private:
    static TestHost& me(void* self) { return *static_cast<TestHost*>(self); }
    vfit_host host_{};
    std::mutex mutex;
    std::condition_variable changed;
};

}  // namespace vfit::virtual_person
