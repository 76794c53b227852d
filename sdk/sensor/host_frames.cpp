// The part of the host table that fills and pushes frames.
#include "core/clock.h"
#include "core/error.h"
#include "core/handles.h"
#include "frame/camera_struct.h"
#include "sensor/host_table.h"
#include "sensor/sized_struct.h"

namespace vfit {

namespace {

constexpr uint32_t kMaxJoints = 1024;     // of one body in one call
constexpr uint32_t kMaxBodies = 64;       // of one frame
constexpr size_t kMaxMetaKey = 64;        // characters
constexpr size_t kMaxMetaJson = 1 << 20;  // characters

Body read_body(const vfit_body* in, const vfit_joint* items, uint32_t stride, uint32_t count) {
    const vfit_body b = read_sized(in, "body");
    // The user map has 8 bits a pixel, and 0 is the background.
    if (b.body_id == 0 || b.body_id > 255)
        fail(VFIT_ERROR_ARGUMENT, "body_id ", b.body_id, " is not in 1..255");
    if (count == 0 || count > kMaxJoints) fail(VFIT_ERROR_ARGUMENT, "a body of ", count, " joints");
    if (!items) fail(VFIT_ERROR_ARGUMENT, "joints is null");
    Body body;
    body.id = b.body_id;
    body.time_ns = b.time_ns;
    body.flags = b.flags & VFIT_BODY_PARTLY_OUT_OF_VIEW;
    for (uint32_t i = 0; i < count; ++i) {
        const auto joint = read_sized<vfit_joint>(reinterpret_cast<const char*>(items) + size_t(i) * stride,
                                                  stride, "joint");
        const Joint value = joint_in(joint);
        body.joints[static_cast<size_t>(joint.joint)] = value;
    }
    return body;
}

}  // namespace

vfit_result HostTable::frame_begin(void* self, void* token, const vfit_frame_layout* layouts, uint32_t stride,
                                   uint32_t count, vfit_frame* out) {
    return enter(self, "frame_begin", [&](HostTable& t) {
        if (!out) fail(VFIT_ERROR_ARGUMENT, "out is null");
        out->id = 0;
        Ref<Frame> frame = t.stream(token)->begin(layouts, stride, count);
        const uint64_t id = Handles::instance().add(Kind::frame, frame, t.context_id_());
        std::unique_lock lock(t.mutex_);
        // The device may have been closed while this waited for a frame.
        if (!t.is_open(token)) {
            lock.unlock();
            Handles::instance().release(id, Kind::frame);
            fail(VFIT_ERROR_STATE, "the device was closed");
        }
        t.filling_.push_back({id, std::move(frame), token});
        out->id = id;
    });
}

vfit_result HostTable::frame_pixels(void* self, vfit_frame handle, vfit_stream kind, void** pixels,
                                    uint32_t* row_stride) {
    return enter(self, "frame_pixels", [&](HostTable& t) {
        if (!pixels) fail(VFIT_ERROR_ARGUMENT, "pixels is null");
        std::lock_guard lock(t.mutex_);
        const Stream* stream = t.filling(handle).frame->find(kind);
        if (!stream) fail(VFIT_ERROR_ARGUMENT, "the frame has no stream ", kind);
        *pixels = const_cast<void*>(stream->data);  // its own buffer, not published yet
        if (row_stride) *row_stride = stream->row_stride;
    });
}

vfit_result HostTable::frame_intrinsics(void* self, vfit_frame handle, const vfit_intrinsics* intrinsics) {
    return enter(self, "frame_intrinsics", [&](HostTable& t) {
        const vfit_intrinsics in = read_sized(intrinsics, "intrinsics");
        std::lock_guard lock(t.mutex_);
        set_intrinsics(t.filling(handle).frame->camera, in);
    });
}

vfit_result HostTable::frame_camera(void* self, vfit_frame handle, const vfit_camera* given) {
    return enter(self, "frame_camera", [&](HostTable& t) {
        const vfit_camera in = read_sized(given, "camera");
        std::lock_guard lock(t.mutex_);
        set_placement(t.filling(handle).frame->camera, in);
    });
}

vfit_result HostTable::frame_body(void* self, vfit_frame handle, const vfit_body* body,
                                  const vfit_joint* items, uint32_t stride, uint32_t count) {
    return enter(self, "frame_body", [&](HostTable& t) {
        const Body value = read_body(body, items, stride, count);
        std::lock_guard lock(t.mutex_);
        std::vector<Body>& bodies = t.filling(handle).frame->bodies;
        for (Body& known : bodies)
            if (known.id == value.id) {
                known = value;
                return;
            }
        if (bodies.size() == kMaxBodies)
            fail(VFIT_ERROR_CAPACITY, "a frame holds at most ", kMaxBodies, " bodies");
        bodies.push_back(value);
    });
}

vfit_result HostTable::frame_meta(void* self, vfit_frame handle, const char* key, const char* json) {
    return enter(self, "frame_meta", [&](HostTable& t) {
        if (!key || !json) fail(VFIT_ERROR_ARGUMENT, "key or json is null");
        const size_t key_length = bounded_length(key, kMaxMetaKey + 1);
        const size_t json_length = bounded_length(json, kMaxMetaJson + 1);
        if (key_length == 0 || key_length > kMaxMetaKey || json_length > kMaxMetaJson)
            fail(VFIT_ERROR_ARGUMENT, "a key of 1..", kMaxMetaKey, " and a text of up to ", kMaxMetaJson,
                 " characters are possible");
        std::lock_guard lock(t.mutex_);
        Frame& frame = *t.filling(handle).frame;
        t.scratch_key_.assign(key, key_length);
        t.scratch_json_.assign(json, json_length);
        frame.set_meta(t.scratch_key_, t.scratch_json_);
    });
}

vfit_result HostTable::frame_push(void* self, void* token, vfit_frame handle, int64_t time_ns) {
    return enter(self, "frame_push", [&](HostTable& t) {
        Filling filling = t.take_filling(handle);
        // From here on the plug-in's id is dead, whatever comes.
        Handles::instance().release(filling.id, Kind::frame);
        if (filling.token != token) fail(VFIT_ERROR_ARGUMENT, "the frame was begun for another stream");
        t.stream(token)->push(std::move(filling.frame), time_ns);
    });
}

void HostTable::frame_drop(void* self, vfit_frame handle) {
    enter(self, "frame_drop", [&](HostTable& t) {
        const Filling filling = t.take_filling(handle);
        Handles::instance().release(filling.id, Kind::frame);
    });
}

}  // namespace vfit
