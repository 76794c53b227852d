// Where a garment ends: hems, cuffs, necks, armholes, the fronts of a coat.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace vfit {

/// Corner after that one in its triangle.
inline uint32_t next_corner(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

/// The borders of a mesh of three indices a triangle, each as the corners at which its sides begin: from
/// indices[corner] to indices[next_corner(corner)].
std::vector<std::vector<uint32_t>> border_lines(std::span<const uint32_t> indices);

}  // namespace vfit
