// Constrained Delaunay triangulation of the inside of a closed line: points one by one (Lawson 1977), then
// the line's own edges by exchanging diagonals (Sloan 1993).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

using Triangles = std::vector<std::array<uint32_t, 3>>;

/// Counter-clockwise triangles over the points inside of the line through the first `outline` of them, in
/// their order (either way round); the others lie inside. VFIT_ERROR_DATA where the line crosses itself or
/// meets a point twice.
Triangles triangulate(std::span<const Vec2> points, uint32_t outline);

}  // namespace vfit
