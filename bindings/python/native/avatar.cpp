#include "avatar.h"

#include "context.h"
#include "joints.h"
#include "scan.h"

namespace vfit_python {

namespace {

vfit_avatar_desc desc_in(const py::object& sex, uint32_t detail, bool paper_colliders, bool single_bones) {
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = sex_in(sex);
    desc.detail = detail;
    desc.flags =
        flag(paper_colliders, VFIT_AVATAR_PAPER_COLLIDERS) | flag(single_bones, VFIT_AVATAR_SINGLE_BONES);
    return desc;
}

template <typename Create>
std::shared_ptr<Avatar> create(const std::shared_ptr<Core>& core, Create&& call) {
    vfit_avatar handle{};
    run([&] { return call(&handle); });
    return make<Avatar>(core, handle);
}

std::shared_ptr<Avatar> from_scan(const Scan& scan, const py::object& sex, uint32_t detail, bool paper,
                                  bool single) {
    const vfit_avatar_desc desc = desc_in(sex, detail, paper, single);
    return create(scan.core(), [&, c = scan.core()->open_handle(), s = scan.get()](vfit_avatar* out) {
        return vfit_avatar_create_from_scan(c, &desc, s, out);
    });
}

std::shared_ptr<Avatar> from_measures(const Context& context, const py::object& measurements,
                                      const py::object& sex, uint32_t detail, bool paper, bool single) {
    const vfit_avatar_desc desc = desc_in(sex, detail, paper, single);
    const std::vector<vfit_measurement> items = measurements_in(measurements);
    return create(context.core(), [&, c = context.handle()](vfit_avatar* out) {
        return vfit_avatar_create(c, &desc, items.data(), sizeof(vfit_measurement),
                                  static_cast<uint32_t>(items.size()), out);
    });
}

std::shared_ptr<Avatar> from_shape(const Context& context, const py::object& shape, const py::object& sex,
                                   uint32_t detail, bool paper, bool single) {
    const vfit_avatar_desc desc = desc_in(sex, detail, paper, single);
    std::vector<vfit_shape_value> items;
    for (const auto& [key, given] : py::dict(shape)) {
        vfit_shape_value v = vfit_shape_value_init();
        set_field(v.key, key.cast<std::string>(), "shape value");
        v.value = given.cast<float>();
        items.push_back(v);
    }
    return create(context.core(), [&, c = context.handle()](vfit_avatar* out) {
        return vfit_avatar_create_from_shape(c, &desc, items.data(), sizeof(vfit_shape_value),
                                             static_cast<uint32_t>(items.size()), out);
    });
}

py::dict shape_values(const Context& context) {
    py::dict out;
    for (const vfit_shape_value& v : list(vfit_shape_list, context.handle()))
        out[py::str(field(v.key))] = value("ShapeValue", v.value, v.minimum, v.maximum);
    return out;
}

void set_pose(const Avatar& avatar, const py::object& given) {
    vfit_pose pose = vfit_pose_init();
    const std::vector<vfit_bone> bones = pose_in(given, pose);
    run([&, a = avatar.get()] {
        return vfit_avatar_pose(a, &pose, bones.data(), sizeof(vfit_bone),
                                static_cast<uint32_t>(bones.size()));
    });
}

py::list colliders(const Avatar& avatar) { return colliders_out(list(vfit_avatar_colliders, avatar.get())); }

py::object joints(const Avatar& avatar) { return joints_out(list(vfit_avatar_joints, avatar.get())); }

py::dict measure_own(const Avatar& avatar, const std::string& json) {
    return measurements_out(list<vfit_measurement>([&, a = avatar.get()](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_avatar_measure_own(a, json.data(), json.size(), items, stride, n);
    }));
}

py::dict measure(const Avatar& avatar) { return measurements_out(list(vfit_avatar_measure, avatar.get())); }

py::list rig(const Avatar& avatar) {
    py::list out;
    for (const vfit_rig_bone& b : list(vfit_avatar_rig, avatar.get()))
        out.append(value("RigBone", field(b.name), b.parent, b.bone < 0 ? py::none() : value("Bone", b.bone),
                         tuple_of(b.rest_position)));
    return out;
}

template <vfit_result (*kAcquire)(vfit_avatar, vfit_frame*)>
std::unique_ptr<Frame> acquire(const Avatar& avatar) {
    vfit_frame frame{};
    run([&, a = avatar.get()] { return kAcquire(a, &frame); });
    return std::make_unique<Frame>(avatar.core(), frame);
}

}  // namespace

void bind_avatar(py::module_& m) {
    closable(py::class_<Avatar, std::shared_ptr<Avatar>>(
                 m, "Avatar", "A posable body. detail 0: 13.7k vertices, 1: 54.8k, 2: 219k.")
                 .def_static("from_scan", &from_scan, "scan"_a, py::kw_only(), "sex"_a = py::none(),
                             "detail"_a = 0, "paper_colliders"_a = false, "single_bones"_a = false,
                             "Size and collider radii of the scanned person.")
                 .def_static("from_measures", &from_measures, "context"_a, "measurements"_a, py::kw_only(),
                             "sex"_a = py::none(), "detail"_a = 0, "paper_colliders"_a = false,
                             "single_bones"_a = false,
                             "The default body scaled to stature_m and, where given, shoulder_breadth_m.")
                 .def_static("from_shape", &from_shape, "context"_a, "shape"_a = py::dict(), py::kw_only(),
                             "sex"_a = py::none(), "detail"_a = 0, "paper_colliders"_a = false,
                             "single_bones"_a = false, "A body by its shape values; see shape_values().")
                 .def("pose", &set_pose, "pose"_a)
                 .def("acquire", &acquire<vfit_avatar_acquire>, "The posed mesh.")
                 .def("acquire_rest", &acquire<vfit_avatar_acquire_rest>,
                      "The unposed mesh that the rig binds to.")
                 .def("rig", &rig, "The bones of the skin, parents before children.")
                 .def("joints", &joints, "Every joint of the posed avatar.")
                 .def("colliders", &colliders, "Spheres and capsules of the posed avatar.")
                 .def("measure", &measure, "Tape measures of the avatar's own body.")
                 .def("measure_own", &measure_own, "json"_a,
                      "Measures of your own, as JSON (docs/measuring.md), taken on the avatar's mesh."));
    py::reinterpret_borrow<py::class_<Context>>(m.attr("Context"))
        .def("shape_values", &shape_values, "key -> ShapeValue of the body model.");
}

}  // namespace vfit_python
