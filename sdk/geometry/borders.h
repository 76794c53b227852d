// Where a surface of triangles ends.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

/// The loops of vertices around the openings of a surface whose sides are of two triangles or of one, all
/// turned the same way. Loops that touch in a vertex stay two.
std::vector<std::vector<uint32_t>> borders(std::span<const uint32_t> indices);

/// Length of the closed line through these vertices.
float length_around(std::span<const Vec3> places, std::span<const uint32_t> loop);

}  // namespace vfit
