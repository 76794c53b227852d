// Motion: raw body in, clean pose out.
#include "avatar.h"
#include "context.h"
#include "joints.h"

namespace vfit_python {

namespace {

class Motion : public Owned<vfit_motion, vfit_motion_destroy> {
public:
    using Owned::Owned;
};

using Number = std::optional<float>;

std::shared_ptr<Motion> create(const Context& context, const std::variant<bool, std::string>& filter,
                               bool limits, bool smooth_rotations, bool feet, const Number& smoothing,
                               const Number& correction, const Number& prediction,
                               const Number& jitter_radius_m, const Number& max_deviation_radius_m,
                               const Number& rotation_divisor, const Number& rotation_divisor_switched,
                               const Number& min_cutoff_hz, const Number& beta,
                               const Number& derivative_cutoff_hz, const Number& prediction_s,
                               const std::string& contact_rule, const py::object& range_of_motion) {
    vfit_motion_desc desc = vfit_motion_desc_init();
    const bool unfiltered = std::holds_alternative<bool>(filter) && !std::get<bool>(filter);
    if (const auto* name = std::get_if<std::string>(&filter))
        desc.filter = choice(*name, "filter",
                             {{"adaptive", VFIT_POSITION_ADAPTIVE},
                              {"holt", VFIT_POSITION_HOLT},
                              {"one_euro", VFIT_POSITION_ONE_EURO}});
    desc.contact_rule = choice(contact_rule, "contact_rule",
                               {{"learnt", VFIT_CONTACT_LEARNT}, {"thresholds", VFIT_CONTACT_THRESHOLDS}});
    desc.min_cutoff_hz = setting(min_cutoff_hz);
    desc.beta = setting(beta);
    desc.derivative_cutoff_hz = setting(derivative_cutoff_hz);
    desc.prediction_s = setting(prediction_s);
    desc.flags = flag(unfiltered, VFIT_MOTION_NO_FILTER) | flag(!limits, VFIT_MOTION_NO_LIMITS) |
                 flag(!smooth_rotations, VFIT_MOTION_NO_SMOOTHING) | flag(!feet, VFIT_MOTION_NO_FEET);
    desc.smoothing = setting(smoothing);
    desc.correction = setting(correction);
    desc.prediction = setting(prediction);
    desc.jitter_radius_m = setting(jitter_radius_m);
    desc.max_deviation_radius_m = setting(max_deviation_radius_m);
    desc.rotation_divisor = setting(rotation_divisor);
    desc.rotation_divisor_switched = setting(rotation_divisor_switched);
    std::string ranges;
    if (!range_of_motion.is_none()) {
        ranges = py::module_::import("json").attr("dumps")(py::dict(range_of_motion)).cast<std::string>();
        desc.range_of_motion = ranges.c_str();
    }
    vfit_motion handle{};
    run([&, h = context.handle()] { return vfit_motion_create(h, &desc, &handle); });
    return make<Motion>(context.core(), handle);
}

bool step(const Motion& motion, const Frame* frame, const std::optional<uint32_t>& body_id,
          const std::optional<int64_t>& now_ns) {
    int64_t now = 0;
    if (now_ns)
        now = *now_ns;
    else if (frame)
        now = time_ns_of(*frame);
    else
        check(vfit_context_time(motion.core()->handle(), &now));
    const uint32_t body = frame ? body_or_active(*frame, body_id) : body_id.value_or(0);
    const vfit_frame handle = frame ? frame->get() : vfit_frame{};
    return run([&, m = motion.get()] { return vfit_motion_step(m, handle, body, now); }) == VFIT_OK;
}

bool step_joints(const Motion& motion, const py::object& joints, const std::optional<int64_t>& time_ns,
                 const std::optional<int64_t>& now_ns) {
    const std::vector<vfit_joint> items = joints_in(joints);
    vfit_body body = vfit_body_init();
    body.body_id = 1;
    if (time_ns)
        body.time_ns = *time_ns;
    else
        check(vfit_context_time(motion.core()->handle(), &body.time_ns));
    const int64_t now = now_ns.value_or(body.time_ns);
    return run([&, m = motion.get()] {
               return vfit_motion_step_body(m, &body, items.data(), sizeof(vfit_joint),
                                            static_cast<uint32_t>(items.size()), now);
           }) == VFIT_OK;
}

py::object pose(const Motion& motion) {
    vfit_pose pose = vfit_pose_init();
    const auto bones = list<vfit_bone>([&, m = motion.get()](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_motion_pose(m, &pose, items, stride, n);
    });
    return pose_out(pose, bones);
}

py::object joints(const Motion& motion) { return joints_out(list(vfit_motion_joints, motion.get())); }

}  // namespace

py::object pose_out(const vfit_pose& pose, const std::vector<vfit_bone>& bones) {
    constexpr py::ssize_t kBones = VFIT_BONE_COUNT;
    py::array_t<float> rotations({kBones, py::ssize_t(4)}), positions({kBones, py::ssize_t(3)});
    std::fill_n(rotations.mutable_data(), kBones * 4, 0.0f);
    std::fill_n(positions.mutable_data(), kBones * 3, 0.0f);
    for (py::ssize_t i = 0; i < kBones; ++i) rotations.mutable_at(i, 3) = 1.0f;
    for (const vfit_bone& b : bones) {
        if (b.bone < 0 || b.bone >= kBones) continue;
        std::copy(std::begin(b.rotation), std::end(b.rotation), rotations.mutable_data(b.bone, 0));
        std::copy(std::begin(b.position), std::end(b.position), positions.mutable_data(b.bone, 0));
    }
    const py::tuple contacts = py::make_tuple((pose.contact_flags & VFIT_CONTACT_LEFT) != 0,
                                              (pose.contact_flags & VFIT_CONTACT_RIGHT) != 0);
    return value("Pose", rotations, positions, pose.time_ns, contacts, tuple_of(pose.root_correction),
                 pose.foot_correction_m);
}

std::vector<vfit_bone> pose_in(const py::object& given, vfit_pose& pose) {
    const auto rotations = FloatArray::ensure(given.attr("rotations"));
    const auto positions = FloatArray::ensure(given.attr("positions"));
    constexpr py::ssize_t kBones = VFIT_BONE_COUNT;
    const auto shaped = [](const FloatArray& array, py::ssize_t columns) {
        return array && array.ndim() == 2 && array.shape(0) == kBones && array.shape(1) == columns;
    };
    if (!shaped(rotations, 4) || !shaped(positions, 3))
        fail(VFIT_ERROR_ARGUMENT, "pose: wanted are rotations (22, 4) and positions (22, 3), one row a bone");
    pose.time_ns = given.attr("time_ns").cast<int64_t>();
    const auto contacts = given.attr("contacts").cast<std::pair<bool, bool>>();
    pose.contact_flags = flag(contacts.first, VFIT_CONTACT_LEFT) | flag(contacts.second, VFIT_CONTACT_RIGHT);
    std::vector<vfit_bone> bones(VFIT_BONE_COUNT, vfit_bone_init());
    for (py::ssize_t i = 0; i < kBones; ++i) {
        vfit_bone& b = bones[static_cast<size_t>(i)];
        b.bone = static_cast<int>(i);
        std::copy_n(rotations.data(i, 0), 4, b.rotation);
        std::copy_n(positions.data(i, 0), 3, b.position);
    }
    return bones;
}

void bind_motion(py::module_& m) {
    const auto preset = py::none();
    closable(py::class_<Motion, std::shared_ptr<Motion>>(
                 m, "Motion", "Turns the bodies of tracked frames into clean poses.")
                 .def(py::init(&create), "context"_a, py::kw_only(), "filter"_a = true, "limits"_a = true,
                      "smooth_rotations"_a = true, "feet"_a = true, "smoothing"_a = preset,
                      "correction"_a = preset, "prediction"_a = preset, "jitter_radius_m"_a = preset,
                      "max_deviation_radius_m"_a = preset, "rotation_divisor"_a = preset,
                      "rotation_divisor_switched"_a = preset, "min_cutoff_hz"_a = preset, "beta"_a = preset,
                      "derivative_cutoff_hz"_a = preset, "prediction_s"_a = preset,
                      "contact_rule"_a = "learnt", "range_of_motion"_a = preset,
                      "Stages by the first four; filter may also name one: 'adaptive' (the default), 'holt' "
                      "with the "
                      "five names of the Kinect SDK, 'one_euro'. None: the library's default.")
                 .def(
                     "bind",
                     [](const Motion& o, const Avatar& a) {
                         run([h = o.get(), g = a.get()] { return vfit_motion_bind(h, g); });
                     },
                     "avatar"_a, "Plants the feet with the avatar's proportions.")
                 .def("step", &step, "frame"_a = py::none(), "body_id"_a = py::none(),
                      "now_ns"_a = py::none(), "True where the body was there. No frame: predicts to now_ns.")
                 .def("step_joints", &step_joints, "joints"_a, "time_ns"_a = py::none(),
                      "now_ns"_a = py::none(),
                      "Joints of yours in world space, without a frame. True where they place the trunk.")
                 .def("pose", &pose)
                 .def("joints", &joints, "The filtered joints behind the pose.")
                 .def("reset", [](const Motion& o) { check(vfit_motion_reset(o.get())); }));
}

}  // namespace vfit_python
