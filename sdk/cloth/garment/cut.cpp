#include "cloth/garment/cut.h"

#include <cmath>

namespace vfit {

namespace {

/// The direction in a triangle in which v grows and u does not: that in which its picture says that the
/// threads run. Where the picture is a point or a line there, the steepest one, as cloth that hangs is mostly
/// cut along the warp.
Vec3 warp_of(const Vec3 (&at)[3], const Vec2 (&uv)[3], const Vec3& normal) {
    const Vec3 a = at[1] - at[0], b = at[2] - at[0];
    const Vec2 p = uv[1] - uv[0], q = uv[2] - uv[0];
    const Vec3 along = q.x * a - p.x * b;  // up to a factor
    const float size = (glm::length(p) * glm::length(b) + glm::length(q) * glm::length(a));
    constexpr float kLeast = 1e-3f;
    if (size > 0.0f && std::isfinite(size) && glm::length(along) > kLeast * size)
        return glm::normalize(along);
    for (const Vec3& axis : {Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        const Vec3 in_plane = axis - glm::dot(axis, normal) * normal;
        if (glm::length(in_plane) > 0.1f) return glm::normalize(in_plane);
    }
    return glm::normalize(a);
}

}  // namespace

std::vector<Vec2> cut_corners(const Garment& garment, const GarmentSize* size) {
    const std::vector<uint32_t>& drawn = garment.uv_indices();
    std::vector<Vec2> cut;
    cut.reserve(drawn.size());
    if (garment.cut_shape.empty()) {
        const std::vector<Vec2>& flat = size ? size->flat : garment.flat;
        for (const uint32_t v : drawn) cut.push_back(flat[v]);
        return cut;
    }
    for (size_t i = 0; i + 2 < drawn.size(); i += 3) {
        const std::vector<uint32_t>& v = garment.mesh.indices;
        const Vec3 at[3] = {garment.cut_shape[v[i]], garment.cut_shape[v[i + 1]],
                            garment.cut_shape[v[i + 2]]};
        const Vec2 uv[3] = {garment.mesh.uvs[drawn[i]], garment.mesh.uvs[drawn[i + 1]],
                            garment.mesh.uvs[drawn[i + 2]]};
        const Vec3 normal = glm::normalize(glm::cross(at[1] - at[0], at[2] - at[0]));
        const Vec3 warp = warp_of(at, uv, normal), weft = glm::cross(warp, normal);
        for (const Vec3& p : at) cut.emplace_back(glm::dot(p - at[0], weft), glm::dot(p - at[0], warp));
    }
    return cut;
}

}  // namespace vfit
