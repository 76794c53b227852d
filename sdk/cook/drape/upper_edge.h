// By which edge a garment without shoulders is worn.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

/// Vertices of the highest opening about the body's axis; where none goes about it, as of what is open in
/// front, of the upper edge of all openings. Empty: it has no opening.
std::vector<uint32_t> upper_edge(std::span<const Vec3> places,
                                 const std::vector<std::vector<uint32_t>>& openings, float axis_z);

float mean_height(std::span<const Vec3> places, const std::vector<uint32_t>& of);

}  // namespace vfit
