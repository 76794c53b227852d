// vfit.h, part "frame".
#include "api/context.h"
#include "api/guard.h"
#include "api/structs.h"
#include "core/clock.h"
#include "frame/camera_struct.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr uint32_t kMaxHostStreams = 3;

Camera read_camera(const vfit_frame_desc& desc) {
    Camera camera;
    set_intrinsics(camera, read(desc.intrinsics, "intrinsics"));
    set_placement(camera, read_or_default(desc.camera, "camera"));
    return camera;
}

struct HostStream {
    vfit_stream kind;
    vfit_view view;
    uint32_t item, row;
};

HostStream check_host_stream(vfit_stream kind, const vfit_view& view, const Camera& camera) {
    const char* name = kind == VFIT_STREAM_DEPTH ? "depth" : kind == VFIT_STREAM_COLOR ? "color" : "user map";
    const vfit_format wanted = kind == VFIT_STREAM_DEPTH   ? VFIT_FORMAT_U16
                               : kind == VFIT_STREAM_COLOR ? VFIT_FORMAT_RGBA8
                                                           : VFIT_FORMAT_U8;
    if (kind != VFIT_STREAM_DEPTH && kind != VFIT_STREAM_COLOR && kind != VFIT_STREAM_USER_MAP)
        fail(VFIT_ERROR_ARGUMENT, "stream ", kind,
             " cannot come from the host: depth, color or user map can");
    if (view.format != wanted)
        fail(VFIT_ERROR_ARGUMENT, name, " view: format ", view.format, ", wanted ", wanted);
    if (!view.data) fail(VFIT_ERROR_ARGUMENT, name, " view: data is null");
    if (view.width != camera.width || view.height != camera.height)
        fail(VFIT_ERROR_ARGUMENT, name, " view: ", view.width, " x ", view.height, ", the intrinsics say ",
             camera.width, " x ", camera.height);
    const uint32_t size = format_size(wanted);
    const uint32_t item = view.item_stride ? view.item_stride : size;
    const uint64_t row = view.row_stride ? view.row_stride : uint64_t(item) * view.width;
    if (item < size) fail(VFIT_ERROR_ARGUMENT, name, " view: item_stride ", item, " is less than ", size);
    if (row < uint64_t(item) * view.width || row > UINT32_MAX)
        fail(VFIT_ERROR_ARGUMENT, name, " view: row_stride ", row, " is too small for a row");
    return {kind, view, item, static_cast<uint32_t>(row)};
}

void copy_pixels(Frame& frame, const HostStream& s) {
    const uint32_t size = format_size(s.view.format);
    auto* to =
        static_cast<unsigned char*>(frame.add_stream(s.kind, s.view.format, s.view.width, s.view.height));
    const auto* from = static_cast<const unsigned char*>(s.view.data);
    for (uint32_t y = 0; y < s.view.height; ++y) {
        const unsigned char* row = from + size_t(y) * s.row;
        if (s.item == size) {
            std::memcpy(to, row, size_t(size) * s.view.width);
        } else {
            for (uint32_t x = 0; x < s.view.width; ++x)
                std::memcpy(to + size_t(x) * size, row + size_t(x) * s.item, size);
        }
        to += size_t(size) * s.view.width;
    }
}

void lend_pixels(Frame& frame, const HostStream& s) {
    const uint32_t size = format_size(s.view.format);
    if (s.item != size || s.row != size * s.view.width)
        fail(VFIT_ERROR_UNSUPPORTED, "pixels that are lent (release given) must be tightly packed");
    if (reinterpret_cast<uintptr_t>(s.view.data) % size != 0)
        fail(VFIT_ERROR_ARGUMENT, "pixels that are lent must lie at a multiple of ", size, " bytes");
    frame.add_view(
        {s.kind, s.view.format, s.view.width, s.view.height, size, s.row, s.view.data, Frame::next_serial()});
}

void require_camera(const Frame& frame) {
    if (frame.camera.width == 0) fail(VFIT_ERROR_ARGUMENT, "the frame has no depth image");
}

bool can_write(vfit_format from, vfit_format to) {
    return from == to || (from == VFIT_FORMAT_U32 && to == VFIT_FORMAT_U16) ||
           (from == VFIT_FORMAT_U16 && to == VFIT_FORMAT_F32);
}

/// Before the first item is written: a failed call leaves the target as it is.
void check_narrow(const Stream& s) {
    const auto* indices = s.as<uint32_t>();
    for (size_t i = 0; i < s.items(); ++i)
        if (indices[i] > UINT16_MAX)
            fail(VFIT_ERROR_CAPACITY, "index ", indices[i], " does not fit the target's 16 bits");
}

/// One item in the target's format, one of those of can_write.
void write_converted(vfit_format from, const unsigned char* in, vfit_format to, unsigned char* out,
                     float unit_m) {
    if (from == to) {
        std::memcpy(out, in, format_size(from));
    } else if (from == VFIT_FORMAT_U32) {
        uint32_t value;
        std::memcpy(&value, in, sizeof value);
        const auto narrow = static_cast<uint16_t>(value);
        std::memcpy(out, &narrow, sizeof narrow);
    } else {
        uint16_t value;
        std::memcpy(&value, in, sizeof value);
        const float metres = float(value) * unit_m;
        std::memcpy(out, &metres, sizeof metres);
    }
}

}  // namespace

vfit_result vfit_frame_create(vfit_context handle, const vfit_frame_desc* desc, vfit_frame* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        const vfit_frame_desc d = read(desc, "desc");
        if (d.count == 0 || d.count > kMaxHostStreams)
            fail(VFIT_ERROR_ARGUMENT, "desc: ", d.count, " streams; 1 to 3 are possible");
        check_pointer(d.streams, "desc.streams");
        check_pointer(d.views, "desc.views");
        // The caller's own struct size is the distance of its views.
        const Items<vfit_view> views(d.views, d.views->struct_size, d.count, "desc.views");
        const Camera camera = read_camera(d);
        HostStream streams[kMaxHostStreams];
        bool depth = false;
        for (uint32_t i = 0; i < d.count; ++i) {
            streams[i] = check_host_stream(d.streams[i], views[i], camera);
            depth = depth || d.streams[i] == VFIT_STREAM_DEPTH;
        }
        if (!depth) fail(VFIT_ERROR_ARGUMENT, "desc: a depth stream is required");
        Ref<Frame> frame = Context::take_frame(*context->frames);
        for (uint32_t i = 0; i < d.count; ++i) {
            if (d.release)
                lend_pixels(*frame, streams[i]);
            else
                copy_pixels(*frame, streams[i]);
        }
        frame->camera = camera;
        frame->time_ns = d.time_ns ? d.time_ns : now_ns();
        out->id = context->publish(Kind::frame, frame);
        // Last of all: a failed call must not release the host's pixels.
        frame->host_release = d.release;
        frame->host_user = d.user;
        return VFIT_OK;
    });
}

vfit_result vfit_frame_retain(vfit_frame frame) {
    return guard([&] {
        Handles::instance().retain(frame.id, Kind::frame);
        return VFIT_OK;
    });
}

vfit_result vfit_frame_release(vfit_frame handle) {
    return guard([&] {
        if (handle.id == 0) return VFIT_OK;
        UseFrame frame(handle);
        Handles::instance().release(handle.id, Kind::frame);
        return VFIT_OK;
    });
}

vfit_result vfit_frame_streams(vfit_frame handle, vfit_stream* items, uint32_t* count) {
    return guard([&] {
        UseFrame frame(handle);
        check_pointer(count, "count");
        const auto kinds = frame->kinds();
        const uint32_t given = *count;
        *count = static_cast<uint32_t>(kinds.size());
        if (!items) return VFIT_OK;
        if (given < kinds.size())
            fail(VFIT_ERROR_CAPACITY, "the array has room for ", given, " items, ", kinds.size(),
                 " are needed");
        std::copy(kinds.begin(), kinds.end(), items);
        return VFIT_OK;
    });
}

vfit_result vfit_frame_view(vfit_frame handle, vfit_stream stream, vfit_view* out) {
    return guard([&] {
        UseFrame frame(handle);
        check_output(out, "out");
        const Stream* s = frame->find(stream);
        if (!s) fail(VFIT_ERROR_ARGUMENT, "the frame has no stream ", stream);
        vfit_view view{};
        view.format = s->format;
        view.data = s->data;
        view.width = s->width;
        view.height = s->height;
        view.item_stride = s->item_stride;
        view.row_stride = s->row_stride;
        view.time_ns = frame->time_ns;
        view.serial = s->serial;
        write(out, view);
        return VFIT_OK;
    });
}

vfit_result vfit_frame_intrinsics(vfit_frame handle, vfit_intrinsics* out) {
    return guard([&] {
        UseFrame frame(handle);
        check_output(out, "out");
        require_camera(*frame);
        write(out, intrinsics_out(frame->camera));
        return VFIT_OK;
    });
}

vfit_result vfit_frame_camera(vfit_frame handle, vfit_camera* out) {
    return guard([&] {
        UseFrame frame(handle);
        check_output(out, "out");
        require_camera(*frame);
        write(out, placement_out(frame->camera));
        return VFIT_OK;
    });
}

vfit_result vfit_frame_meta(vfit_frame handle, const char* key, char* buffer, uint32_t capacity,
                            uint32_t* length) {
    return guard([&]() -> vfit_result {
        UseFrame frame(handle);
        check_pointer(key, "key");
        const std::string* json = frame->meta(key);
        if (!json) return VFIT_NOT_READY;
        const uint32_t n = write_text(json->data(), json->size(), buffer, capacity);
        if (length) *length = n;
        return VFIT_OK;
    });
}

vfit_result vfit_frame_write(vfit_frame handle, vfit_stream stream, const vfit_target* target,
                             uint64_t* serial) {
    return guard([&]() -> vfit_result {
        UseFrame frame(handle);
        const vfit_target t = read(target, "target");
        const Stream* s = frame->find(stream);
        if (!s) fail(VFIT_ERROR_ARGUMENT, "the frame has no stream ", stream);
        if (serial && *serial == s->serial) return VFIT_NOT_READY;
        const vfit_format format = t.format == VFIT_FORMAT_NONE ? s->format : t.format;
        const uint32_t size = format_size(format);
        if (size == 0) fail(VFIT_ERROR_ARGUMENT, "target: unknown format ", t.format);
        check_pointer(t.data, "target.data");
        const uint64_t stride = t.item_stride ? t.item_stride : size;
        if (stride < size) fail(VFIT_ERROR_ARGUMENT, "target: item_stride ", stride, " is less than ", size);
        const uint64_t items = s->items();
        const uint64_t need = items == 0 ? 0 : (items - 1) * stride + size;
        if (t.capacity < need)
            fail(VFIT_ERROR_CAPACITY, "target: ", t.capacity, " bytes, ", need, " are needed for ", items,
                 " items");
        if (!can_write(s->format, format))
            fail(VFIT_ERROR_UNSUPPORTED, "stream ", stream, " of format ", s->format,
                 " cannot be written as format ", format);
        if (s->format == VFIT_FORMAT_U32 && format == VFIT_FORMAT_U16) check_narrow(*s);
        const auto* from = static_cast<const unsigned char*>(s->data);
        auto* to = static_cast<unsigned char*>(t.data);
        if (format == s->format && stride == size && s->item_stride == size) {
            std::memcpy(to, from, static_cast<size_t>(items) * size);
        } else {
            for (uint64_t i = 0; i < items; ++i)
                write_converted(s->format, from + i * s->item_stride, format, to + i * stride,
                                frame->camera.depth_unit_m);
        }
        if (serial) *serial = s->serial;
        return VFIT_OK;
    });
}
