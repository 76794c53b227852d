// Cloth that closes sleeves, legs or the neck of a garment: figures of games are modelled so, to hide that
// there is no body inside.
#pragma once

#include <cstdint>
#include <vector>

#include "cook/model/pieces.h"

namespace vfit {

/// Discs with a sharp or rounded edge all around, across the cloth that ends there, with the walls of the pit
/// of which they may be the floor: each a list of triangles. Pockets and buttons can look the same.
std::vector<std::vector<uint32_t>> find_caps(const Soup& soup);

/// Without these lists of triangles.
Soup without(const Soup& soup, const std::vector<std::vector<uint32_t>>& lists);

}  // namespace vfit
