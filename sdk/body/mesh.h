// A triangle mesh: right-handed, counter-clockwise seen from outside, metres.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

struct Mesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;      // empty, or one a vertex, unit length
    std::vector<Vec2> uvs;          // empty, or one a vertex; v = 0 at the top of the picture
    std::vector<uint32_t> indices;  // three a triangle
};

/// Area-weighted vertex normals into `normals` (resized to the vertex count; no other allocation).
void compute_normals(std::span<const Vec3> positions, std::span<const uint32_t> indices,
                     std::vector<Vec3>& normals);

}  // namespace vfit
