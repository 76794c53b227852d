#include "avatar.h"

#include "arrays.h"
#include "context.h"
#include "joints.h"
#include "scan.h"

namespace vfit_python {

namespace {

vfit_avatar_desc desc_in(const py::object& sex, uint32_t detail, bool paper_colliders, bool single_bones,
                         bool dual, bool limbs_as_posed) {
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = sex_in(sex);
    desc.detail = detail;
    desc.flags = flag(paper_colliders, VFIT_AVATAR_PAPER_COLLIDERS) |
                 flag(single_bones, VFIT_AVATAR_SINGLE_BONES) | flag(dual, VFIT_AVATAR_DUAL_QUATERNIONS) |
                 flag(limbs_as_posed, VFIT_AVATAR_LIMBS_AS_POSED);
    return desc;
}

template <typename Create>
std::shared_ptr<Avatar> create(const std::shared_ptr<Core>& core, Create&& call) {
    vfit_avatar handle{};
    run([&] { return call(&handle); });
    return make<Avatar>(core, handle);
}

std::shared_ptr<Avatar> from_scan(const Scan& scan, const py::object& sex, uint32_t detail, bool paper,
                                  bool single, bool dual, bool limbs_as_posed) {
    const vfit_avatar_desc desc = desc_in(sex, detail, paper, single, dual, limbs_as_posed);
    return create(scan.core(), [&, c = scan.core()->open_handle(), s = scan.get()](vfit_avatar* out) {
        return vfit_avatar_create_from_scan(c, &desc, s, out);
    });
}

std::shared_ptr<Avatar> from_measures(const Context& context, const py::object& measurements,
                                      const py::object& sex, uint32_t detail, bool paper, bool single,
                                      bool dual, bool limbs_as_posed) {
    const vfit_avatar_desc desc = desc_in(sex, detail, paper, single, dual, limbs_as_posed);
    const std::vector<vfit_measurement> items = measurements_in(measurements);
    return create(context.core(), [&, c = context.handle()](vfit_avatar* out) {
        return vfit_avatar_create(c, &desc, items.data(), sizeof(vfit_measurement),
                                  static_cast<uint32_t>(items.size()), out);
    });
}

std::shared_ptr<Avatar> from_shape(const Context& context, const py::object& shape, const py::object& sex,
                                   uint32_t detail, bool paper, bool single, bool dual, bool limbs_as_posed) {
    const vfit_avatar_desc desc = desc_in(sex, detail, paper, single, dual, limbs_as_posed);
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

/// An own character from a path or from the bytes of a file.
std::shared_ptr<Avatar> load(const Context& context, const py::object& file, const py::object& bone_map,
                             float scale, bool paper, bool single, bool dual, bool limbs_as_posed) {
    const vfit_avatar_desc desc = desc_in(py::none(), 0, paper, single, dual, limbs_as_posed);
    vfit_character_desc character = vfit_character_desc_init();
    character.scale = scale;
    std::string path, bytes, map;
    if (py::isinstance<py::bytes>(file)) {
        bytes = file.cast<std::string>();
        character.bytes = bytes.data();
        character.byte_count = bytes.size();
    } else {
        path = py::module_::import("os").attr("fspath")(file).cast<std::string>();
        character.path = path.c_str();
    }
    if (!bone_map.is_none()) {
        map = py::module_::import("json").attr("dumps")(py::dict(bone_map)).cast<std::string>();
        character.bone_map = map.c_str();
    }
    return create(context.core(), [&, c = context.handle()](vfit_avatar* out) {
        return vfit_avatar_load(c, &desc, &character, out);
    });
}

py::object describe(const Avatar& avatar) {
    vfit_character_info info = vfit_character_info_init();
    run([&, a = avatar.get()] { return vfit_avatar_describe(a, &info); });
    constexpr const char* kKinds[] = {"body", "gltf", "vrm0", "vrm1"};
    py::array_t<float> from_file({4, 4});
    for (py::ssize_t row = 0; row < 4; ++row)
        for (py::ssize_t column = 0; column < 4; ++column)
            from_file.mutable_at(row, column) = info.from_file[4 * column + row];
    return value("CharacterInfo", kKinds[info.kind], field(info.name), info.stature_m, info.vertex_count,
                 info.index_count, info.bone_count, from_file);
}

py::list parts(const Avatar& avatar) {
    py::list out;
    for (const vfit_avatar_part& p : list(vfit_avatar_parts, avatar.get()))
        out.append(value("AvatarPart", field(p.mesh), field(p.material_name),
                         p.material < 0 ? py::none() : py::object(py::int_(p.material)), p.first_index,
                         p.index_count));
    return out;
}

template <typename Call>
py::bytes packed(Call&& call) {
    uint32_t count = 0;
    run([&] { return call(nullptr, &count); });
    std::string bytes(count, char(0));
    run([&] { return call(bytes.data(), &count); });
    return py::bytes(bytes);
}

py::bytes pack(const Avatar& avatar, const std::string& size_label) {
    return packed([&, a = avatar.get()](void* bytes, uint32_t* count) {
        return vfit_avatar_pack(a, size_label.c_str(), bytes, count);
    });
}

py::tuple unpack(const Context& context, const py::bytes& given, uint32_t detail, bool paper, bool single,
                 bool dual, bool limbs_as_posed) {
    const vfit_avatar_desc desc = desc_in(py::none(), detail, paper, single, dual, limbs_as_posed);
    const std::string bytes = given;
    char label[32] = "";
    const auto avatar = create(context.core(), [&, c = context.handle()](vfit_avatar* out) {
        return vfit_avatar_unpack(c, &desc, bytes.data(), static_cast<uint32_t>(bytes.size()), label,
                                  sizeof label, out);
    });
    return py::make_tuple(avatar, std::string(label));
}

py::bytes pack_pose(const Context& context, const py::object& given) {
    vfit_pose pose = vfit_pose_init();
    const std::vector<vfit_bone> bones = pose_in(given, pose);
    return packed([&, c = context.handle()](void* bytes, uint32_t* count) {
        return vfit_pose_pack(c, &pose, bones.data(), sizeof(vfit_bone), static_cast<uint32_t>(bones.size()),
                              bytes, count);
    });
}

py::object unpack_pose(const Context& context, const py::bytes& given) {
    const std::string bytes = given;
    vfit_pose pose = vfit_pose_init();
    const auto bones = list<vfit_bone>([&, c = context.handle()](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_pose_unpack(c, bytes.data(), static_cast<uint32_t>(bytes.size()), &pose, items, stride,
                                n);
    });
    return pose_out(pose, bones);
}

void pose_into(const Avatar& avatar, const py::object& given, const py::array& positions,
               const py::object& normals) {
    vfit_pose pose = vfit_pose_init();
    const std::vector<vfit_bone> bones = pose_in(given, pose);
    const vfit_target p = target_in(positions, VFIT_FORMAT_F32X3);
    vfit_target n = vfit_target_init();
    if (!normals.is_none()) n = target_in(normals.cast<py::array>(), VFIT_FORMAT_F32X3);
    run([&, a = avatar.get(), with = !normals.is_none()] {
        return vfit_avatar_pose_into(a, &pose, bones.data(), sizeof(vfit_bone),
                                     static_cast<uint32_t>(bones.size()), &p, with ? &n : nullptr);
    });
}

py::list colliders(const Avatar& avatar) { return colliders_out(list(vfit_avatar_colliders, avatar.get())); }

py::object joints(const Avatar& avatar) { return joints_out(list(vfit_avatar_joints, avatar.get())); }

py::dict measure_own(const Avatar& avatar, const std::string& json) {
    return measurements_out(
        list<vfit_measurement>([&, a = avatar.get()](auto* items, uint32_t stride, uint32_t* n) {
            return vfit_avatar_measure_own(a, json.data(), json.size(), items, stride, n);
        }));
}

py::dict measure(const Avatar& avatar) { return measurements_out(list(vfit_avatar_measure, avatar.get())); }

py::list rig(const Avatar& avatar) {
    py::list out;
    for (const vfit_rig_bone& b : list(vfit_avatar_rig, avatar.get()))
        out.append(value("RigBone", field(b.name), b.parent, b.bone < 0 ? py::none() : value("Bone", b.bone),
                         tuple_of(b.rest_position), tuple_of(b.rest_rotation),
                         b.node < 0 ? py::none() : py::object(py::int_(b.node))));
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
    closable(
        py::class_<Avatar, std::shared_ptr<Avatar>>(
            m, "Avatar", "A posable body. detail 0: 13.7k vertices, 1: 54.8k, 2: 219k, 3: 1.0k, for crowds.")
            .def_static("from_scan", &from_scan, "scan"_a, py::kw_only(), "sex"_a = py::none(),
                        "detail"_a = 0, "paper_colliders"_a = false, "single_bones"_a = false,
                        "dual_quaternions"_a = false, "limbs_as_posed"_a = false,
                        "Size and collider radii of the scanned person.")
            .def_static("from_measures", &from_measures, "context"_a, "measurements"_a, py::kw_only(),
                        "sex"_a = py::none(), "detail"_a = 0, "paper_colliders"_a = false,
                        "single_bones"_a = false, "dual_quaternions"_a = false, "limbs_as_posed"_a = false,
                        "The default body scaled to stature_m and, where given, shoulder_breadth_m.")
            .def_static("from_shape", &from_shape, "context"_a, "shape"_a = py::dict(), py::kw_only(),
                        "sex"_a = py::none(), "detail"_a = 0, "paper_colliders"_a = false,
                        "single_bones"_a = false, "dual_quaternions"_a = false, "limbs_as_posed"_a = false,
                        "A body by its shape values; see shape_values().")
            .def_static("load", &load, "context"_a, "file"_a, py::kw_only(), "bone_map"_a = py::none(),
                        "scale"_a = 1.0f, "paper_colliders"_a = false, "single_bones"_a = false,
                        "dual_quaternions"_a = false, "limbs_as_posed"_a = false,
                        "A character of yours: glTF 2.0 or VRM, a path or the file's bytes.")
            .def_static("unpack", &unpack, "context"_a, "packet"_a, py::kw_only(), "detail"_a = 0,
                        "paper_colliders"_a = false, "single_bones"_a = false, "dual_quaternions"_a = false,
                        "limbs_as_posed"_a = false, "(avatar, size label) of what pack gave.")
            .def("pack", &pack, "size_label"_a = "", "Body and size for the network, at most 240 bytes.")
            .def("describe", &describe)
            .def("parts", &parts, "Triangles by material.")
            .def("pose", &set_pose, "pose"_a)
            .def("pose_into", &pose_into, "pose"_a, "positions"_a, "normals"_a = py::none(),
                 "Poses, and writes the skin into arrays of yours, (vertices, 3) float32 of any stride.")
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
        .def("shape_values", &shape_values, "key -> ShapeValue of the body model.")
        .def("pack_pose", &pack_pose, "pose"_a, "A pose for the network, at most 120 bytes.")
        .def("unpack_pose", &unpack_pose, "packet"_a);
}

}  // namespace vfit_python
