// A surface with few vertices for people in a crowd: some of the fine one's, so that shape, skin and UVs are
// theirs.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_model.h"

namespace vfit {

struct SimplifiedSurface {
    BodyTopology topology;
    std::vector<uint32_t> sources;  // the fine geometric vertex of each geometric vertex
};

/// About `vertex_count` geometric vertices of the fine surface, chosen at its given positions by quadric
/// errors (meshoptimizer); seams of the UV map stay closed.
SimplifiedSurface simplify_surface(const BodyTopology& fine, std::span<const Vec3> positions,
                                   uint32_t vertex_count);

}  // namespace vfit
