// Cloth that lies on a body, moved off what stands out through it.
#pragma once

#include <cstdint>
#include <span>

#include "geometry/mesh_query.h"
#include "math/types.h"

namespace vfit {

struct SkinSurface {
    std::span<const Vec3> positions;
    std::span<const uint32_t> indices;
    const MeshQuery& query;  // of these
};

/// Vertices are kept off the skin, what lies between them is not: where skin stands out through one of these
/// triangles (three indices each), its corners move outwards, by half millimetres, 2 cm at most.
void clear_skin(const SkinSurface& skin, std::span<const uint32_t> triangles, std::span<Vec3> places);

}  // namespace vfit
