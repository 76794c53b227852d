// Garment and Cloth: a garment on an avatar, simulated.
#include <array>
#include <limits>
#include <set>

#include "avatar.h"
#include "context.h"
#include "frame.h"

namespace vfit_python {

namespace {

class Garment : public Owned<vfit_garment, vfit_garment_destroy> {
public:
    using Owned::Owned;
};

class Prop : public Owned<vfit_prop, vfit_prop_destroy> {
public:
    using Owned::Owned;
};

class Cloth : public Owned<vfit_cloth, vfit_cloth_destroy> {
public:
    using Owned::Owned;
    vfit_avatar wearer{};
    std::set<std::shared_ptr<Prop>> props;  // are there as long as it meets them
};

using Floats = py::array_t<float, py::array::c_style | py::array::forcecast>;
using Indices = py::array_t<uint32_t, py::array::c_style | py::array::forcecast>;

std::shared_ptr<Prop> create_prop(const Context& context, const vfit_prop_desc& desc) {
    vfit_prop handle{};
    run([&, h = context.handle()] { return vfit_prop_create(h, &desc, &handle); });
    return make<Prop>(context.core(), handle);
}

std::shared_ptr<Prop> create_shape(const Context& context, vfit_prop_shape shape,
                                   const std::array<float, 3>& size) {
    vfit_prop_desc desc = vfit_prop_desc_init();
    desc.shape = shape;
    std::copy(size.begin(), size.end(), desc.size);
    return create_prop(context, desc);
}

uint32_t rows_of_three(const py::array& values, const char* name) {
    if (values.ndim() != 2 || values.shape(1) != 3)
        throw py::value_error(std::string(name) + " must have the shape (n, 3)");
    return uint32_t(values.shape(0));
}

std::shared_ptr<Prop> create_mesh(const Context& context, const Floats& positions, const Indices& triangles) {
    vfit_prop_desc desc = vfit_prop_desc_init();
    desc.shape = VFIT_PROP_MESH;
    desc.vertex_count = rows_of_three(positions, "positions");
    desc.positions = positions.data();
    desc.index_count = 3 * rows_of_three(triangles, "triangles");
    desc.indices = triangles.data();
    return create_prop(context, desc);
}

std::shared_ptr<Garment> open(const Context& context, const std::string& name) {
    vfit_garment handle{};
    run([&, h = context.handle()] { return vfit_garment_open(h, name.c_str(), &handle); });
    return make<Garment>(context.core(), handle);
}

std::shared_ptr<Garment> load(const Context& context, const std::string& json) {
    vfit_garment handle{};
    run([&, h = context.handle()] { return vfit_garment_load(h, json.data(), json.size(), &handle); });
    return make<Garment>(context.core(), handle);
}

py::object info(const Garment& garment) {
    vfit_garment_info i = vfit_garment_info_init();
    const vfit_garment handle = garment.get();
    check(vfit_garment_describe(handle, &i));
    py::list sizes;
    for (uint32_t n = 0; n < i.size_count; ++n)
        sizes.append(text([&](char* b, uint32_t c) { return vfit_garment_size_label(handle, n, b, c); }));
    return value("GarmentInfo", field(i.name), field(i.garment_kind), field(i.fabric), i.vertex_count,
                 i.simulated_count, py::tuple(sizes), field(i.size_chart), value("Sex", i.body_sex));
}

std::shared_ptr<Cloth> create(const Avatar& avatar, const Garment& garment,
                              const std::optional<std::string>& size, uint32_t substeps,
                              const std::optional<std::array<float, 3>>& gravity,
                              const std::optional<float>& friction, const std::optional<float>& damping,
                              float thickness_m, bool hands, bool skin, bool sleeps,
                              const std::array<float, 3>& wind, float drag, float lift,
                              const std::optional<float>& inertia, float self_thickness_m, float budget_ms,
                              bool pressure, float cover_m, float virtual_m, bool any_fit,
                              float carry_speed_m_s, float carry_way_m) {
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    desc.size_label = size ? size->c_str() : nullptr;
    desc.substeps = substeps;
    if (gravity) {
        std::copy(gravity->begin(), gravity->end(), desc.gravity);
        // The library takes all zero for its default; this is no gravity to a float, but not all zero.
        if (*gravity == std::array<float, 3>{}) desc.gravity[1] = -std::numeric_limits<float>::min();
    }
    desc.friction = setting(friction);
    desc.damping = setting(damping);
    desc.thickness_m = thickness_m;
    desc.flags = flag(!hands, VFIT_CLOTH_NO_HANDS) | flag(skin, VFIT_CLOTH_SKIN) |
                 flag(!sleeps, VFIT_CLOTH_AWAKE) | flag(pressure, VFIT_CLOTH_PRESSURE) |
                 flag(any_fit, VFIT_CLOTH_ANY_FIT);
    std::copy(wind.begin(), wind.end(), desc.wind);
    desc.drag = drag;
    desc.lift = lift;
    desc.inertia = setting(inertia);
    desc.self_thickness_m = self_thickness_m;
    desc.budget_ms = budget_ms;
    desc.cover_m = cover_m;
    desc.virtual_m = virtual_m;
    desc.carry_speed_m_s = carry_speed_m_s;
    desc.carry_way_m = carry_way_m;
    vfit_cloth handle{};
    run([&, a = avatar.get(), g = garment.get()] { return vfit_cloth_create(a, g, &desc, &handle); });
    auto cloth = make<Cloth>(avatar.core(), handle);
    cloth->wearer = avatar.get();
    return cloth;
}

py::array_t<bool> hide_skin(
    const Cloth& cloth, float margin_m,
    const std::optional<py::array_t<bool, py::array::c_style | py::array::forcecast>>& before) {
    vfit_frame rest{};
    check(vfit_avatar_acquire_rest(cloth.wearer, &rest));
    vfit_view indices = vfit_view_init();
    const vfit_result viewed = vfit_frame_view(rest, VFIT_STREAM_INDEX, &indices);
    vfit_frame_release(rest);
    check(viewed);
    const uint32_t count = before ? uint32_t(before->size()) : indices.width / 3;
    std::vector<uint8_t> hidden(count);
    if (before) std::copy_n(before->data(), count, hidden.begin());
    run([&, c = cloth.get()] { return vfit_cloth_hide_skin(c, margin_m, hidden.data(), count); });
    py::array_t<bool> out(count);
    std::copy(hidden.begin(), hidden.end(), out.mutable_data());
    return out;
}

std::unique_ptr<Frame> acquire(const Cloth& cloth) {
    vfit_frame frame{};
    run([&, c = cloth.get()] { return vfit_cloth_acquire(c, &frame); });
    return std::make_unique<Frame>(cloth.core(), frame);
}

py::object stats(const Cloth& cloth) {
    vfit_cloth_stats s = vfit_cloth_stats_init();
    check(vfit_cloth_describe(cloth.get(), &s));
    return value("ClothStats", s.vertex_count, s.simulated_count, s.constraint_count, s.strain_mean,
                 s.strain_p99, s.strain_max, s.step_ms, s.substeps, s.collider_count, s.sleeves_taken_up_m,
                 s.legs_taken_up_m);
}

uint64_t state_hash(const Cloth& cloth) {
    uint64_t hash = 0;
    run([&, c = cloth.get()] { return vfit_cloth_state_hash(c, &hash); });
    return hash;
}

py::list parts(const Garment& garment) {
    uint32_t count = 0;
    check(vfit_garment_parts(garment.get(), nullptr, sizeof(vfit_garment_part), &count));
    std::vector<vfit_garment_part> items(count);
    check(vfit_garment_parts(garment.get(), items.data(), sizeof(vfit_garment_part), &count));
    py::list out;
    for (const vfit_garment_part& p : items)
        out.append(value("GarmentPart", field(p.material), field(p.texture),
                         py::make_tuple(p.color[0], p.color[1], p.color[2]), p.first_index, p.index_count));
    return out;
}

py::list fit(const Cloth& cloth) {
    uint32_t count = 0;
    check(vfit_cloth_fit(cloth.get(), nullptr, sizeof(vfit_fit_zone), &count));
    std::vector<vfit_fit_zone> items(count);
    check(vfit_cloth_fit(cloth.get(), items.data(), sizeof(vfit_fit_zone), &count));
    py::list out;
    for (const vfit_fit_zone& z : items) {
        const char* verdict = z.fit == VFIT_FIT_TIGHT ? "tight" : z.fit == VFIT_FIT_LOOSE ? "loose" : "right";
        out.append(value("FitZone", field(z.key), verdict, z.body_m, z.garment_m, z.ease_m, z.strain,
                         z.pressure_pa, z.opening_m));
    }
    return out;
}

py::array_t<float> fit_map(const Cloth& cloth) {
    vfit_frame frame{};
    check(vfit_cloth_acquire(cloth.get(), &frame));
    vfit_view view = vfit_view_init();
    const vfit_result found = vfit_frame_view(frame, VFIT_STREAM_POSITION, &view);
    vfit_frame_release(frame);
    check(found);
    py::array_t<float> out(view.width);
    float* values = out.mutable_data();
    run([&, h = cloth.get()] { return vfit_cloth_fit_map(h, values, view.width); });
    return out;
}

std::vector<vfit_cloth> handles_of(const std::vector<std::shared_ptr<Cloth>>& cloths) {
    std::vector<vfit_cloth> handles;
    for (const auto& cloth : cloths) handles.push_back(cloth->get());
    return handles;
}

py::list outfit_check(const std::vector<std::shared_ptr<Cloth>>& cloths) {
    const std::vector<vfit_cloth> handles = handles_of(cloths);
    const auto n = uint32_t(handles.size());
    constexpr uint32_t kProps = 64;                 // of a cloth, at most
    uint32_t count = n * (n + 3) / 2 + n * kProps;  // one for each pair of surfaces
    std::vector<vfit_crossing> items(count);
    run([&] { return vfit_outfit_check(handles.data(), n, items.data(), sizeof(vfit_crossing), &count); });
    py::list out;
    for (uint32_t i = 0; i < count; ++i) {
        const vfit_crossing& c = items[i];
        const char* kind = c.kind == VFIT_CROSSING_SELF   ? "self"
                           : c.kind == VFIT_CROSSING_SKIN ? "skin"
                           : c.kind == VFIT_CROSSING_PROP ? "prop"
                                                          : "cloth";
        out.append(value("Crossing", kind, c.cloth, c.other, c.pair_count, c.triangle, c.other_triangle));
    }
    return out;
}

py::tuple outfit_skin(const std::vector<std::shared_ptr<Cloth>>& cloths) {
    const std::vector<vfit_cloth> handles = handles_of(cloths);
    vfit_frame frame{};
    uint32_t pairs = 0;
    run([&] { return vfit_outfit_skin(handles.data(), uint32_t(handles.size()), &frame, &pairs); });
    return py::make_tuple(std::make_unique<Frame>(cloths.front()->core(), frame), pairs);
}

constexpr float kStep_s = 1.0f / 60.0f;

}  // namespace

void bind_cloth(py::module_& m) {
    m.def("outfit_check", &outfit_check, "cloths"_a,
          "Pairs of surfaces of an outfit that cross after its last steps; empty: none do.");
    m.def("outfit_skin", &outfit_skin, "cloths"_a,
          "The avatar's mesh to draw below an outfit: skin gives way where it would come through a garment. "
          "And how many pairs of triangles still cross.");
    closable(
        py::class_<Garment, std::shared_ptr<Garment>>(m, "Garment",
                                                      "A garment that can be worn (docs/garments.md).")
            .def_static("open", &open, "context"_a, "name"_a, "A garment that comes with vfit, by its name.")
            .def_static("load", &load, "context"_a, "json"_a, "A garment of your own, as JSON text.")
            .def_property_readonly("info", &info)
            .def_property_readonly("parts", &parts, "Triangles by their look."));
    closable(
        py::class_<Prop, std::shared_ptr<Prop>>(
            m, "Prop", "A solid beside a body that cloth stays outside of: a chair, a weapon, a bag, hair.")
            .def_static(
                "sphere",
                [](const Context& c, float radius) {
                    return create_shape(c, VFIT_PROP_SPHERE, {radius, 0.0f, 0.0f});
                },
                "context"_a, "radius"_a)
            .def_static(
                "capsule",
                [](const Context& c, float radius, float half_length) {
                    return create_shape(c, VFIT_PROP_CAPSULE, {radius, half_length, 0.0f});
                },
                "context"_a, "radius"_a, "half_length"_a,
                "half_length: from the middle to each of the two centres, along the up axis.")
            .def_static(
                "box",
                [](const Context& c, const std::array<float, 3>& half) {
                    return create_shape(c, VFIT_PROP_BOX, half);
                },
                "context"_a, "half"_a, "half: of each edge.")
            .def_static("mesh", &create_mesh, "context"_a, "positions"_a, "triangles"_a,
                        "positions: (n, 3). triangles: (m, 3), wound as those of a frame.")
            .def(
                "move",
                [](const Prop& p, const std::array<float, 3>& position,
                   const std::array<float, 4>& rotation) {
                    run([&, h = p.get()] { return vfit_prop_move(h, position.data(), rotation.data()); });
                },
                "position"_a, "rotation"_a = std::array<float, 4>{0.0f, 0.0f, 0.0f, 1.0f},
                "Where it is at the end of the next step. rotation: xyzw.")
            .def(
                "deform",
                [](const Prop& p, const Floats& positions) {
                    const uint32_t count = rows_of_three(positions, "positions");
                    const float* data = positions.data();
                    run([=, h = p.get()] { return vfit_prop_deform(h, data, count); });
                },
                "positions"_a, "The vertices of a mesh, in its own frame: (n, 3)."));
    closable(
        py::class_<Cloth, std::shared_ptr<Cloth>>(m, "Cloth",
                                                  "A garment on an avatar. Pose the avatar first, then step.")
            .def(
                py::init(&create), py::keep_alive<1, 2>(), "avatar"_a, "garment"_a, py::kw_only(),
                "size"_a = py::none(), "substeps"_a = 0, "gravity"_a = py::none(), "friction"_a = py::none(),
                "damping"_a = py::none(), "thickness_m"_a = 0.0f, "hands"_a = true, "skin"_a = false,
                "sleeps"_a = true, "wind"_a = std::array<float, 3>{}, "drag"_a = 0.0f, "lift"_a = 0.0f,
                "inertia"_a = py::none(), "self_thickness_m"_a = 0.0f, "budget_ms"_a = 0.0f,
                "pressure"_a = false, "cover_m"_a = 0.0f, "virtual_m"_a = 0.0f, "any_fit"_a = false,
                "carry_speed_m_s"_a = 0.0f, "carry_way_m"_a = 0.0f,
                "size None: made to the avatar. substeps 0: 8 a 1/60 s. hands False: forearms and hands pass "
                "through all but their own sleeve. skin True: kept out of the avatar's skin itself, not of "
                "its spheres "
                "and capsules. "
                "drag and lift: of the air, about 1. inertia: share of the body's own motion that the cloth "
                "feels. "
                "self_thickness_m: kept between the cloth's own layers. budget_ms: of a step. "
                "pressure True: frames tell what the body presses with, in Pa. "
                "cover_m: more spheres and capsules, until no skin is so far outside of all. "
                "virtual_m: points of triangles so near each other meet the body too: for coarse meshes. "
                "any_fit True: worn even where it would not close. "
                "carry_speed_m_s, carry_way_m: a body that moves faster or further in a step jumps, and the "
                "cloth feels nothing of it; 0: 6 and 0.06, below 0: no limit.")
            .def(
                "teleport", [](const Cloth& c) { run([h = c.get()] { return vfit_cloth_teleport(h); }); },
                "The avatar's pose at the next step is a jump from the last one: the cloth is carried along.")
            .def(
                "set_wind",
                [](const Cloth& c, const std::array<float, 3>& wind) {
                    run([h = c.get(), &wind] { return vfit_cloth_set_wind(h, wind.data()); });
                },
                "wind"_a, "Velocity of the air from the next step on.")
            .def(
                "set_quality",
                [](const Cloth& c, uint32_t substeps, float budget_ms) {
                    run([=, h = c.get()] { return vfit_cloth_set_quality(h, substeps, budget_ms); });
                },
                "substeps"_a = 0, "budget_ms"_a = 0.0f,
                "Sub-steps a 1/60 s at most, and what a step may take.")
            .def(
                "set_size",
                [](const Cloth& c, const std::optional<std::string>& size) {
                    run([&, h = c.get()] { return vfit_cloth_set_size(h, size ? size->c_str() : nullptr); });
                },
                "size"_a = py::none(),
                "Another size of the garment, from how it hangs now; None: made to the avatar.")
            .def(
                "add_prop",
                [](Cloth& c, const std::shared_ptr<Prop>& prop) {
                    run([h = c.get(), p = prop->get()] { return vfit_cloth_add_prop(h, p); });
                    c.props.insert(prop);
                },
                py::arg("prop").none(false), "Stays outside of that prop from the next step on.")
            .def(
                "remove_prop",
                [](Cloth& c, const std::shared_ptr<Prop>& prop) {
                    run([h = c.get(), p = prop->get()] { return vfit_cloth_remove_prop(h, p); });
                    c.props.erase(prop);
                },
                py::arg("prop").none(false))
            .def("fit", &fit, "How it sits, by girths of the trunk.")
            .def("fit_map", &fit_map, "One value a vertex: above 0 tight, below 0 loose.")
            .def(
                "wear_over",
                [](const Cloth& c, const Cloth& inner) {
                    run([h = c.get(), i = inner.get()] { return vfit_cloth_wear_over(h, i); });
                },
                "inner"_a,
                "Puts this on over that cloth, and stays outside of it from now on; step the inner one "
                "first.")
            .def(
                "hide_skin", &hide_skin, "margin_m"_a = 0.0f, "hidden"_a = py::none(),
                "One True a triangle of the avatar's that this garment hides: leave it out of what you draw. "
                "hidden: of the garments before, to add to.")
            .def(
                "step",
                [](const Cloth& c, float dt) { run([h = c.get(), dt] { return vfit_cloth_step(h, dt); }); },
                "dt"_a = kStep_s)
            .def(
                "begin_step",
                [](const Cloth& c, float dt) {
                    run([h = c.get(), dt] { return vfit_cloth_begin_step(h, dt); });
                },
                "dt"_a = kStep_s, "Starts a step on a worker and returns.")
            .def(
                "end_step", [](const Cloth& c) { run([h = c.get()] { return vfit_cloth_end_step(h); }); },
                "Waits for the step that was begun.")
            .def(
                "carry", [](const Cloth& c) { run([h = c.get()] { return vfit_cloth_carry(h); }); },
                "Between steps: acquire then gives the last step's cloth, carried into the avatar's pose of "
                "now.")
            .def(
                "reset", [](const Cloth& c) { run([h = c.get()] { return vfit_cloth_reset(h); }); },
                "Put on anew, on a body that stands straight and goes into the avatar's pose: about 0.1 s.")
            .def("acquire", &acquire, "positions, normals, uvs, triangles and strain.")
            .def("stats", &stats)
            .def("state_hash", &state_hash, "Equal hashes mean an equal state."));
}

}  // namespace vfit_python
