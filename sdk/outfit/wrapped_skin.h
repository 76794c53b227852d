// Collision proxy of the skin: concave regions narrower than a cloth triangle are filled.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

/// Contact keeps the vertices of cloth off the skin, not its triangles: these would cut a bump that is
/// smaller than they are. So concave regions, such as the surroundings of a bump, are raised to the mean of
/// their neighbours, and round regions by the sagitta of a cloth edge. No vertex moves inwards. Three indices
/// a triangle of a closed mesh.
std::vector<Vec3> wrapped_skin(std::span<const Vec3> positions, std::span<const uint32_t> indices);

}  // namespace vfit
