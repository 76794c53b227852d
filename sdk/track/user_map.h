// From labelled cells to labelled pixels.
#pragma once

#include <cstdint>

#include "track/depth_grid.h"

namespace vfit {

/// Writes one byte a pixel: the label of the pixel's cell where the pixel's reading is on the cell's surface,
/// else 0. A pixel at the outline whose reading lies between both surfaces (a time-of-flight camera mixes
/// them) goes to the one that it is nearer to. Pixels without a reading are nobody's.
void write_user_map(const DepthImage& image, const DepthGrid& grid, const uint8_t* labels, uint8_t* users);

}  // namespace vfit
