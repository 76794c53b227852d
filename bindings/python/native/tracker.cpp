// Tracker: bodies into frames, from the frame's own source or from the host.
#include "context.h"
#include "joints.h"

namespace vfit_python {

namespace {

class Tracker : public Owned<vfit_tracker, vfit_tracker_destroy> {
public:
    using Owned::Owned;
};

vfit_track_source source_in(const std::string& given, const char* name) {
    return choice(
        given, name,
        {{"auto", VFIT_TRACK_AUTO}, {"built_in", VFIT_TRACK_BUILT_IN}, {"given", VFIT_TRACK_GIVEN}});
}

std::shared_ptr<Tracker> create(const Context& context, const py::object& floor, const std::string& joints,
                                const std::string& user_map, const std::string& follow,
                                const std::string& filter, const std::string& fit) {
    const vfit_camera camera = floor.is_none() ? vfit_camera_init() : camera_in(floor);
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    if (!floor.is_none()) desc.floor = &camera;
    desc.joints = source_in(joints, "joints");
    desc.user_map = source_in(user_map, "user_map");
    desc.follow = choice(follow, "follow",
                         {{"nearest", VFIT_FOLLOW_NEAREST},
                          {"centred", VFIT_FOLLOW_CENTRED},
                          {"first", VFIT_FOLLOW_FIRST},
                          {"chosen", VFIT_FOLLOW_CHOSEN}});
    desc.filter = choice(filter, "filter",
                         {{"auto", VFIT_FILTER_AUTO}, {"on", VFIT_FILTER_ON}, {"off", VFIT_FILTER_OFF}});
    desc.fit = choice(fit, "fit",
                      {{"auto", VFIT_FIT_AUTO}, {"off", VFIT_FIT_OFF}, {"everybody", VFIT_FIT_EVERYBODY}});
    vfit_tracker handle{};
    run([&, h = context.handle()] { return vfit_tracker_create(h, &desc, &handle); });
    return make<Tracker>(context.core(), handle);
}

std::unique_ptr<Frame> update(const Tracker& tracker, const Frame& frame) {
    vfit_frame tracked{};
    run([&, t = tracker.get(), f = frame.get()] { return vfit_tracker_update(t, f, &tracked); });
    return std::make_unique<Frame>(tracker.core(), tracked);
}

std::unique_ptr<Frame> track(const Tracker& tracker, const py::array& depth, const py::sequence& intrinsics,
                             const py::object& users, const py::object& camera, int64_t time_ns) {
    return update(tracker,
                  *frame_from_numpy(tracker.core(), depth, intrinsics, users, py::none(), camera, time_ns));
}

void hint(const Tracker& tracker, const py::dict& hints, uint32_t body_id) {
    std::vector<vfit_joint_hint> items;
    for (const auto& [key, given] : hints) {
        const auto numbers = given.cast<std::vector<float>>();
        if (numbers.size() != 2 && numbers.size() != 3)
            fail(VFIT_ERROR_ARGUMENT,
                 "hint of " + py::str(key).cast<std::string>() + ": wanted is (x, y) or (x, y, confidence)");
        vfit_joint_hint item = vfit_joint_hint_init();
        item.body_id = body_id;
        item.joint = joint_id(key);
        item.x = numbers[0];
        item.y = numbers[1];
        item.confidence = numbers.size() == 3 ? numbers[2] : 1.0f;
        items.push_back(item);
    }
    run([&, t = tracker.get()] {
        return vfit_tracker_hint(t, items.data(), sizeof(vfit_joint_hint),
                                 static_cast<uint32_t>(items.size()));
    });
}

void hint_from(const Tracker& tracker, const Frame& seen, const std::array<float, 3>& position,
               const std::array<float, 4>& rotation, const std::optional<uint32_t>& body_id) {
    const uint32_t body = body_or_active(seen, body_id);
    run([&, t = tracker.get(), f = seen.get()] {
        return vfit_tracker_hint_from(t, f, body, position.data(), rotation.data());
    });
}

using Points = py::array_t<float, py::array::c_style | py::array::forcecast>;

py::object align_worlds(const Context& context, const Points& here, const Points& there) {
    for (const auto& points : {here, there})
        if (points.ndim() != 2 || points.shape(1) != 3 || points.shape(0) != here.shape(0))
            throw py::value_error("here and there must have the same shape (n, 3)");
    std::array<float, 3> position{};
    std::array<float, 4> rotation{};
    float rms = 0.0f;
    const float *a = here.data(), *b = there.data();
    const auto count = static_cast<uint32_t>(here.shape(0));
    run([&, h = context.handle()] {
        return vfit_world_align(h, a, b, count, position.data(), rotation.data(), &rms);
    });
    return value("WorldPlace", py::tuple(py::cast(position)), py::tuple(py::cast(rotation)), rms);
}

void choose(const Tracker& tracker, const std::optional<uint32_t>& body_id) {
    run([&, t = tracker.get()] { return vfit_tracker_set_active(t, body_id.value_or(0)); });
}

std::unique_ptr<Frame> submit(const Tracker& tracker, const Frame& frame, const py::object& joints,
                              uint32_t body_id, int64_t time_ns, bool camera_space, bool partly_out_of_view) {
    const std::vector<vfit_joint> items = joints_in(joints);
    vfit_body body = vfit_body_init();
    body.body_id = body_id;
    body.time_ns = time_ns;
    body.flags =
        flag(camera_space, VFIT_BODY_CAMERA_SPACE) | flag(partly_out_of_view, VFIT_BODY_PARTLY_OUT_OF_VIEW);
    vfit_frame tracked{};
    run([&, t = tracker.get(), f = frame.get()] {
        return vfit_tracker_submit(t, f, &body, items.data(), sizeof(vfit_joint),
                                   static_cast<uint32_t>(items.size()), &tracked);
    });
    return std::make_unique<Frame>(tracker.core(), tracked);
}

}  // namespace

void bind_tracker(py::module_& m) {
    m.def(
        "align_worlds", &align_worlds, "context"_a, "here"_a, "there"_a,
        "Where another camera's world space lies in this one's, from points (n, 3) that both saw at the same "
        "times.");
    closable(
        py::class_<Tracker, std::shared_ptr<Tracker>>(m, "Tracker",
                                                      "Makes tracked frames: images, user map and bodies.")
            .def(py::init(&create), "context"_a, py::kw_only(), "floor"_a = py::none(), "joints"_a = "auto",
                 "user_map"_a = "auto", "follow"_a = "nearest", "filter"_a = "auto", "fit"_a = "auto",
                 "floor: a Camera that says where the floor is, if the frames do not. joints, user_map: "
                 "\"auto\" (the source's where it tells them, else the tracker's), \"built_in\" or "
                 "\"given\". follow: who is the active person, \"nearest\", \"centred\", \"first\" or "
                 "\"chosen\". filter: joints steadied over time, \"auto\" (not those of the source), "
                 "\"on\" or \"off\". fit: whose joints are those of a body fitted to the depth, \"auto\" "
                 "(the active person's), \"off\" or \"everybody\".")
            .def("update", &update, "frame"_a,
                 "The frame with the bodies that its source supplies, or those that the tracker finds.")
            .def("track", &track, "depth"_a, "intrinsics"_a, py::kw_only(), "users"_a = py::none(),
                 "camera"_a = py::none(), "time_ns"_a = 0,
                 "From a depth image (height, width) uint16 in millimetres and (fx, fy, cx, cy) to the "
                 "frame with user map and bodies.")
            .def("hint", &hint, "hints"_a, py::kw_only(), "body_id"_a = 0,
                 "Joints that you see in the image, name -> (x, y) or (x, y, confidence) in pixels, for "
                 "the next update alone.")
            .def("hint_from", &hint_from, "seen"_a, "position"_a,
                 "rotation"_a = std::array<float, 4>{0.0f, 0.0f, 0.0f, 1.0f}, "body_id"_a = py::none(),
                 "A person as the tracker of another camera saw them, for the next update alone; position "
                 "and rotation: its world space in this one's.")
            .def("choose", &choose, "body_id"_a,
                 "That person is the active one from the next frame on; None: by the rule again.")
            .def("submit", &submit, "frame"_a, "joints"_a, py::kw_only(), "body_id"_a = 1, "time_ns"_a = 0,
                 "camera_space"_a = false, "partly_out_of_view"_a = false,
                 "The frame with a body of your own; submit to the result to add a second one.")
            .def("reset", [](const Tracker& t) { check(vfit_tracker_reset(t.get())); }));
}

}  // namespace vfit_python
