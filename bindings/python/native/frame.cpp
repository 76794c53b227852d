// Frame: what it is made of, and frames made from arrays.
#include "frame.h"

#include "arrays.h"
#include "context.h"
#include "joints.h"

namespace vfit_python {

namespace {

std::vector<vfit_stream> streams_of(const Frame& frame) {
    uint32_t count = 0;
    check(vfit_frame_streams(frame.get(), nullptr, &count));
    std::vector<vfit_stream> kinds(count);
    check(vfit_frame_streams(frame.get(), kinds.data(), &count));
    return kinds;
}

py::tuple streams(const Frame& frame) {
    py::list out;
    for (const vfit_stream kind : streams_of(frame)) out.append(value("Stream", kind));
    return py::tuple(out);
}

bool contains(const Frame& frame, int stream) {
    for (const vfit_stream kind : streams_of(frame))
        if (kind == stream) return true;
    return false;
}

vfit_view view_of(const Frame& frame, vfit_stream stream) {
    vfit_view view = vfit_view_init();
    check(vfit_frame_view(frame.get(), stream, &view));
    return view;
}

py::object intrinsics(const Frame& frame) {
    vfit_intrinsics k = vfit_intrinsics_init();
    check(vfit_frame_intrinsics(frame.get(), &k));
    return value("Intrinsics", k.fx, k.fy, k.cx, k.cy, k.width, k.height, tuple_of(k.distortion));
}

py::object camera(const Frame& frame) {
    vfit_camera c = vfit_camera_init();
    check(vfit_frame_camera(frame.get(), &c));
    // Column-major, so that its transpose is what numpy means by rows.
    const py::array_t<float> columns({4, 4}, c.world_from_camera);
    return value("Camera", value("FloorState", c.floor_state), c.depth_unit_m, c.height_m, c.tilt_rad,
                 c.roll_rad, tuple_of(c.floor_normal), c.floor_distance_m, columns.attr("T"));
}

py::object meta(const Frame& frame, const std::string& key) {
    uint32_t length = 0;
    if (check(vfit_frame_meta(frame.get(), key.c_str(), nullptr, 0, &length)) == VFIT_NOT_READY)
        return py::none();
    std::string json(length, '\0');
    check(vfit_frame_meta(frame.get(), key.c_str(), json.data(), length + 1, &length));
    return py::module_::import("json").attr("loads")(json);
}

struct Active {
    uint32_t id = 0;
    vfit_active_state state = VFIT_ACTIVE_NOBODY;
};

Active active_of(const Frame& frame) {
    Active out;
    check(vfit_frame_active_body(frame.get(), &out.id, &out.state));
    return out;
}

py::list bodies(const Frame& frame) {
    py::list out;
    for (const vfit_body& b : list(vfit_frame_bodies, frame.get()))
        out.append(value("Body", b.body_id, b.time_ns, (b.flags & VFIT_BODY_PARTLY_OUT_OF_VIEW) != 0,
                         joints_of(frame, b.body_id)));
    return out;
}

uint64_t write(const Frame& frame, int stream, const py::array& out, uint64_t serial) {
    const vfit_target target = target_in(out, view_of(frame, stream).format);
    run([&, f = frame.get()] { return vfit_frame_write(f, stream, &target, &serial); });
    return serial;
}

vfit_intrinsics intrinsics_in(const py::sequence& given, uint32_t width, uint32_t height) {
    if (py::len(given) < 4) fail(VFIT_ERROR_ARGUMENT, "intrinsics: fx, fy, cx and cy are needed");
    vfit_intrinsics k = vfit_intrinsics_init();
    const auto number = [&](size_t i) { return given[i].cast<float>(); };
    k.fx = number(0);
    k.fy = number(1);
    k.cx = number(2);
    k.cy = number(3);
    k.width = py::len(given) > 4 ? given[4].cast<uint32_t>() : 0;
    k.height = py::len(given) > 5 ? given[5].cast<uint32_t>() : 0;
    if (k.width == 0) k.width = width;
    if (k.height == 0) k.height = height;
    if (py::len(given) > 6) {
        const auto distortion = given[6].cast<std::vector<float>>();
        if (distortion.size() > std::size(k.distortion))
            fail(VFIT_ERROR_ARGUMENT, "intrinsics: at most 8 distortion coefficients");
        std::copy(distortion.begin(), distortion.end(), k.distortion);
    }
    return k;
}

std::unique_ptr<Frame> from_numpy(const Context& context, const py::array& depth,
                                  const py::sequence& intrinsics, const py::object& users,
                                  const py::object& color, const py::object& camera, int64_t time_ns) {
    return frame_from_numpy(context.core(), depth, intrinsics, users, color, camera, time_ns);
}

template <vfit_stream kStream>
py::array get(const Frame& frame) {
    return array_of(frame, kStream, view_of(frame, kStream));
}

}  // namespace

std::unique_ptr<Frame> frame_from_numpy(const std::shared_ptr<Core>& core, const py::array& depth,
                                        const py::sequence& intrinsics, const py::object& users,
                                        const py::object& color, const py::object& camera, int64_t time_ns) {
    std::vector<py::array> pixels;  // keeps the copies that were needed
    std::vector<vfit_stream> kinds;
    std::vector<vfit_view> views;
    const auto add = [&](vfit_stream kind, const ImageArray& image) {
        pixels.push_back(image.pixels);
        kinds.push_back(kind);
        views.push_back(image.view);
    };
    add(VFIT_STREAM_DEPTH, depth_in(depth));
    if (!users.is_none()) add(VFIT_STREAM_USER_MAP, users_in(users));
    if (!color.is_none()) add(VFIT_STREAM_COLOR, color_in(color));
    const vfit_intrinsics k = intrinsics_in(intrinsics, views[0].width, views[0].height);
    const vfit_camera c = camera.is_none() ? vfit_camera_init() : camera_in(camera);
    vfit_frame_desc desc = vfit_frame_desc_init();
    desc.count = static_cast<uint32_t>(kinds.size());
    desc.streams = kinds.data();
    desc.views = views.data();
    desc.intrinsics = &k;
    desc.camera = &c;
    desc.time_ns = time_ns;
    vfit_frame frame{};
    run([&, h = core->open_handle()] { return vfit_frame_create(h, &desc, &frame); });
    return std::make_unique<Frame>(core, frame);
}

int64_t time_ns_of(const Frame& frame) {
    const auto kinds = streams_of(frame);
    return kinds.empty() ? 0 : view_of(frame, kinds.front()).time_ns;
}

uint32_t body_or_active(const Frame& frame, const std::optional<uint32_t>& body_id) {
    return body_id ? *body_id : active_of(frame).id;
}

vfit_camera camera_in(const py::object& given) {
    vfit_camera c = vfit_camera_init();
    c.floor_state = given.attr("floor_state").cast<int>();
    c.depth_unit_m = given.attr("depth_unit_m").cast<float>();
    c.floor_distance_m = given.attr("floor_distance_m").cast<float>();
    const auto normal = given.attr("floor_normal").cast<std::array<float, 3>>();
    std::copy(normal.begin(), normal.end(), c.floor_normal);
    return c;
}

void bind_frame(py::module_& m) {
    py::class_<Frame>(
        m, "Frame",
        "Immutable bundle of images or vertex data with one time stamp. Arrays are views without a "
        "copy, read-only, and stay valid for as long as you hold them.")
        .def_static("from_numpy", &from_numpy, "context"_a, "depth"_a, "intrinsics"_a, py::kw_only(),
                    "users"_a = py::none(), "color"_a = py::none(), "camera"_a = py::none(), "time_ns"_a = 0,
                    "A frame from your own pixels, which are copied.")
        .def_property_readonly("streams", &streams)
        .def("__contains__", &contains, "stream"_a)
        .def(
            "view", [](const Frame& f, int stream) { return array_of(f, stream, view_of(f, stream)); },
            "stream"_a, "The stream as an array; see docs/python.md for the shapes.")
        .def(
            "serial", [](const Frame& f, int stream) { return view_of(f, stream).serial; }, "stream"_a,
            "Equal serials of one stream mean equal content.")
        .def("write", &write, "stream"_a, "out"_a, "serial"_a = 0,
             "Copies a stream into your array, at its own type and stride, unless serial is already the "
             "stream's; "
             "returns the stream's serial.")
        .def_property_readonly("time_ns", &time_ns_of)
        .def_property_readonly("depth", &get<VFIT_STREAM_DEPTH>)
        .def_property_readonly("color", &get<VFIT_STREAM_COLOR>)
        .def_property_readonly("users", &get<VFIT_STREAM_USER_MAP>)
        .def_property_readonly("positions", &get<VFIT_STREAM_POSITION>)
        .def_property_readonly("normals", &get<VFIT_STREAM_NORMAL>)
        .def_property_readonly("uvs", &get<VFIT_STREAM_UV>)
        .def_property_readonly("triangles", &get<VFIT_STREAM_INDEX>)
        .def_property_readonly("bone_matrices", &get<VFIT_STREAM_BONE_MATRIX>)
        .def_property_readonly("skin_bones", &get<VFIT_STREAM_SKIN_BONES>)
        .def_property_readonly("skin_weights", &get<VFIT_STREAM_SKIN_WEIGHTS>)
        .def_property_readonly("strain", &get<VFIT_STREAM_STRAIN>)
        .def_property_readonly("pressure", &get<VFIT_STREAM_PRESSURE>)
        .def_property_readonly("intrinsics", &intrinsics)
        .def_property_readonly("camera", &camera)
        .def("meta", &meta, "key"_a, "What the source says beside the pixels, or None.")
        .def("bodies", &bodies, "The people in a tracked frame.")
        .def(
            "joints",
            [](const Frame& f, const std::optional<uint32_t>& id) {
                return joints_of(f, body_or_active(f, id));
            },
            "body_id"_a = py::none(), "The joints of one body, by default of the active one.")
        .def_property_readonly(
            "active_body",
            [](const Frame& f) {
                const uint32_t id = active_of(f).id;
                return id ? py::object(py::int_(id)) : py::none();
            },
            "The id of the person to follow, who may be out of sight (ActiveState.LOST); None: no person.")
        .def_property_readonly("active_state",
                               [](const Frame& f) { return value("ActiveState", active_of(f).state); })
        .def(
            "close", [](Frame& f) { f.reference.release(); }, "Gives the frame back before it is collected.")
        .def_property_readonly("closed", [](const Frame& f) { return f.reference.released(); })
        .def("__enter__", [](py::object self) { return self; })
        .def("__exit__", [](Frame& f, const py::args&) { f.reference.release(); });
}

}  // namespace vfit_python
