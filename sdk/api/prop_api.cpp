// vfit.h, part "avatar and cloth": props.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "api/bodies.h"
#include "api/cloth_object.h"
#include "api/guard.h"
#include "api/prop_object.h"
#include "api/structs.h"
#include "math/finite.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr float kSmallest_m = 0.001f, kLargest_m = 10.0f, kFarthest_m = 1e4f;

Vec3 checked_point(const float* p, const Axes& axes, const char* what, size_t index) {
    const Vec3 point = axes.point_in({p[0], p[1], p[2]});
    for (int k = 0; k < 3; ++k)
        if (!(std::abs(point[k]) <= kFarthest_m))  // nor for what is not finite
            fail(VFIT_ERROR_ARGUMENT, what, " ", index,
                 " is not finite, or further than 10 km from the origin");
    return point;
}

void read_points(const float* positions, uint32_t count, const Axes& axes, std::vector<Vec3>& out) {
    out.resize(count);
    for (size_t i = 0; i < count; ++i) out[i] = checked_point(positions + 3 * i, axes, "position", i);
}

float checked_size(float size_m, const char* what) {
    if (!(size_m >= kSmallest_m && size_m <= kLargest_m))
        fail(VFIT_ERROR_ARGUMENT, "desc.size: ", what, " of ", size_m, " m is not in ", kSmallest_m, "..",
             kLargest_m, " m");
    return size_m;
}

Mesh given_mesh(const vfit_prop_desc& desc, const Axes& axes) {
    check_pointer(desc.positions, "desc.positions");
    check_pointer(desc.indices, "desc.indices");
    if (desc.vertex_count > PropMesh::kMaxVertices)
        fail(VFIT_ERROR_ARGUMENT, "desc.vertex_count ", desc.vertex_count, " is more than ",
             PropMesh::kMaxVertices);
    constexpr uint32_t kMaxIndices = 1u << 20;
    if (desc.index_count % 3 != 0 || desc.index_count > kMaxIndices)
        fail(VFIT_ERROR_ARGUMENT, "desc.index_count ", desc.index_count,
             " is not a multiple of 3, or more than ", kMaxIndices);
    Mesh mesh;
    read_points(desc.positions, desc.vertex_count, axes, mesh.positions);
    mesh.indices.assign(desc.indices, desc.indices + desc.index_count);
    if (axes.flips_winding())
        for (size_t t = 0; t < mesh.indices.size(); t += 3)
            std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
    return mesh;
}

Mesh mesh_of(const vfit_prop_desc& desc, const Axes& axes) {
    const auto length = [&](int k, const char* what) {
        return checked_size(axes.length_in(desc.size[k]), what);
    };
    switch (desc.shape) {
        case VFIT_PROP_SPHERE: return sphere_mesh(length(0, "a radius"));
        case VFIT_PROP_CAPSULE: return capsule_mesh(length(0, "a radius"), length(1, "half a length"));
        case VFIT_PROP_BOX:
            for (int k = 0; k < 3; ++k) length(k, "half an edge");
            return box_mesh(glm::abs(axes.point_in({desc.size[0], desc.size[1], desc.size[2]})));
        case VFIT_PROP_MESH: return given_mesh(desc, axes);
        default: fail(VFIT_ERROR_ARGUMENT, "desc.shape ", desc.shape, " is no shape of a prop");
    }
}

}  // namespace

vfit_result vfit_prop_create(vfit_context handle, const vfit_prop_desc* desc, vfit_prop* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(desc, "desc");
        const auto prop = make<PropObject>(context.ref(), mesh_of(read(desc, "desc"), context->axes));
        out->id = context->publish(Kind::prop, prop);
        return VFIT_OK;
    });
}

vfit_result vfit_prop_destroy(vfit_prop prop) {
    return guard([&] {
        destroy<PropObject>(prop.id);
        return VFIT_OK;
    });
}

vfit_result vfit_prop_move(vfit_prop handle, const float position[3], const float rotation[4]) {
    return guard([&] {
        Use<PropObject, Mode::exclusive> prop(handle.id);
        check_pointer(position, "position");
        const Axes& axes = prop->context->axes;
        const Vec3 at = checked_point(position, axes, "position", 0);
        prop->prop.move(at, rotation_in(rotation, axes));
        return VFIT_OK;
    });
}

vfit_result vfit_prop_deform(vfit_prop handle, const float* positions, uint32_t vertex_count) {
    return guard([&] {
        Use<PropObject, Mode::exclusive> prop(handle.id);
        check_pointer(positions, "positions");
        if (vertex_count > PropMesh::kMaxVertices)
            fail(VFIT_ERROR_ARGUMENT, "vertex_count ", vertex_count, " is more than ",
                 PropMesh::kMaxVertices);
        read_points(positions, vertex_count, prop->context->axes, prop->given);
        prop->prop.deform(prop->given);
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_add_prop(vfit_cloth handle, vfit_prop prop_handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        Use<PropObject, Mode::read> prop(prop_handle.id);
        cloth->meet(prop.ref());
        return VFIT_OK;
    });
}

vfit_result vfit_cloth_remove_prop(vfit_cloth handle, vfit_prop prop_handle) {
    return guard([&] {
        Use<ClothObject, Mode::exclusive> cloth(handle.id);
        Use<PropObject, Mode::any> prop(prop_handle.id);
        cloth->pass(prop.ref());
        return VFIT_OK;
    });
}
