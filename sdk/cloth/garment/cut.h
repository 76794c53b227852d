// The triangles of a garment as they are cut from flat cloth.
#pragma once

#include <vector>

#include "cloth/garment/garment.h"

namespace vfit {

/// One place a corner of the triangles, metres, y along the warp: Garment::flat, or each triangle of
/// Garment::cut_shape laid down by itself. size: one that may have flat triangles of its own; null: the
/// garment's. The garment has either.
std::vector<Vec2> cut_corners(const Garment& garment, const GarmentSize* size = nullptr);

}  // namespace vfit
