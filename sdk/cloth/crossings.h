// Triangles that go through each other: what a cloth at rest must not have.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "math/types.h"

namespace vfit {

/// Pairs of triangles of one mesh, three indices each, that cross and share no vertex.
std::vector<std::pair<uint32_t, uint32_t>> crossed_triangles(std::span<const Vec3> positions, std::span<const uint32_t> indices);

struct MeshView {
    std::span<const Vec3> positions;
    std::span<const uint32_t> indices;
};
/// Pairs of a triangle of a and one of b that cross.
std::vector<std::pair<uint32_t, uint32_t>> crossed_triangles(const MeshView& a, const MeshView& b);

}  // namespace vfit
