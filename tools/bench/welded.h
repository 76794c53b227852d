// Meshes as they are judged: copies of a vertex at seams are one.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "client/client.h"
#include "geometry/mesh_query.h"
#include "math/types.h"

namespace vfit::tools {

/// A mesh whose vertices at one place are one; triangles in the order of the frame's.
struct Welded {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
};
Welded mesh_of(vfit_avatar avatar);
Welded mesh_of(vfit_cloth cloth);
/// The skin as it is drawn below an outfit; took_ms: to make it.
Welded skin_below(std::span<const vfit_cloth> outfit, float* took_ms);
/// Closest points and rays on it.
MeshQuery query_of(const Welded& mesh);

/// Pairs of triangles that cross: of one mesh, which share no vertex, or one of each mesh.
using CrossedTriangles = std::vector<std::pair<uint32_t, uint32_t>>;
CrossedTriangles crossings(const Welded& mesh);
CrossedTriangles crossings(const Welded& a, const Welded& b);

/// The way of 99 of 100 vertices, in millimetres, at most.
double ways_mm(std::span<const Vec3> from, std::span<const Vec3> to);

}  // namespace vfit::tools
