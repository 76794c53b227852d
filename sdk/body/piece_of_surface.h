// A part of the body's surface by itself: its triangles, and what it encloses.
#pragma once

#include <cstdint>
#include <vector>

#include "body/body_model.h"

namespace vfit {

/// Triangles whose corners all belong to `part`.
std::vector<uint32_t> triangles_of(const BodyTopology& topology, BodyPart part);

/// Volume of a piece of surface, its holes closed by fans about their middle.
double enclosed_volume(const std::vector<Vec3>& positions, const std::vector<uint32_t>& triangles);

}  // namespace vfit
