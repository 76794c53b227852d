// A mesh that is drawn in place of the one that is simulated, and goes with it: as its author modelled it,
// with thickness, buttons and details that no simulation needs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

class MeshQuery;

/// One item a drawn vertex, except the indices.
struct DrawnMesh {
    std::vector<uint32_t> triangles;  // of the simulated mesh, each the closest
    std::vector<Vec2> weights;        // of its second and third corner, where the closest point is
    std::vector<Vec3> offsets;        // from there, in metres, in the frame of that place
    std::vector<Vec3> normals;        // in that frame, of unit length
    std::vector<Vec2> uvs;            // v = 0 at the top of the picture
    std::vector<uint32_t> indices;    // three a triangle

    bool empty() const { return triangles.empty(); }
    uint32_t vertex_count() const { return uint32_t(triangles.size()); }
};

/// A simulated mesh as it lies.
struct CarryingMesh {
    std::span<const uint32_t> indices;
    std::span<const Vec3> positions, normals;
};

/// The place of a drawn vertex: on the simulated mesh, with X along its triangle's first side and Z along the
/// normal there, which has no jump between triangles.
struct DrawnFrame {
    Vec3 origin;
    Mat3 axes;

    DrawnFrame(const CarryingMesh& mesh, uint32_t triangle, const Vec2& weights);
};

/// Binds vertices to the closest places of a simulated mesh, which `query` holds too.
DrawnMesh bind_drawn(const CarryingMesh& mesh, const MeshQuery& query, std::span<const Vec3> positions,
                     std::span<const Vec3> normals);

}  // namespace vfit
