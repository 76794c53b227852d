// From labelled cells to labelled pixels.
#pragma once

#include <cstdint>

#include "track/depth_grid.h"

namespace vfit {

/// Writes one byte a pixel: the label of the pixel's cell where the pixel's reading is on the cell's surface,
/// else 0. Pixels without a reading are nobody's.
void write_user_map(const DepthImage& image, const DepthGrid& grid, const uint8_t* labels, uint8_t* users);

}  // namespace vfit
