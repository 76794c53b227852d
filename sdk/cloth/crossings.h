// Triangles that go through each other: what a cloth at rest must not have.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/contact/triangle_groups.h"

namespace vfit {

/// Pairs of triangles of one mesh, three indices each, that cross and share no vertex.
std::vector<TrianglePair> crossed_triangles(std::span<const Vec3> positions,
                                            std::span<const uint32_t> indices);

struct MeshView {
    std::span<const Vec3> positions;
    std::span<const uint32_t> indices;
};
/// Pairs of a triangle of a and one of b that cross.
std::vector<TrianglePair> crossed_triangles(const MeshView& a, const MeshView& b);

}  // namespace vfit
