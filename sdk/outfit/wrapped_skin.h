// The skin as cloth meets it: what is hollow within the reach of a triangle of cloth is filled by as much as
// that spans.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

/// Vertices of cloth keep off the skin, triangles between them do not: on a bump that is smaller than a
/// triangle they would cut it. So hollows, such as the surroundings of a bump, are raised towards their
/// neighbours' middle, and what is round by as much as a side of cloth lies below it. Nothing goes inwards.
/// Three indices a triangle of a closed mesh.
std::vector<Vec3> wrapped_skin(std::span<const Vec3> positions, std::span<const uint32_t> indices);

}  // namespace vfit
