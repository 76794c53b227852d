// A coarse triangle mesh over a fine one: vertices spread evenly, joined where their neighbourhoods meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

struct CoarseSurface {
    std::vector<uint32_t> vertices;   // of the fine mesh
    std::vector<uint32_t> triangles;  // three a triangle, indices into `vertices`, oriented as the fine mesh
};

/// Farthest-point sampling (Gonzalez 1985) in space scaled by `density` (one a vertex: 2 puts samples twice
/// as close), then the dual of the geodesic Voronoi cells of the samples.
CoarseSurface coarse_surface(std::span<const Vec3> positions, std::span<const uint32_t> triangles,
                             std::span<const float> density, uint32_t count);

}  // namespace vfit
