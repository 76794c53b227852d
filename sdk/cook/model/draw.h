// A garment drawn as it was modelled, on the mesh that is simulated.
#pragma once

#include <vector>

#include "cloth/garment/garment.h"
#include "cook/model/pieces.h"
#include "geometry/mesh_query.h"

namespace vfit {

/// These triangles of the soup become what is drawn of the garment, with their materials. `cloth`: its
/// cut_shape, which stands where the soup does.
void draw(const Soup& soup, const std::vector<uint32_t>& triangles, const MeshQuery& cloth, Garment& garment);

}  // namespace vfit
