// Which side of a garment's triangles is out, and which of them lie there, whatever layers, linings, double
// sides and loose parts it was modelled with.
#pragma once

#include <vector>

#include "cook/model/pieces.h"

namespace vfit {

/// A patch of the outer side.
struct Facet {
    Vec3 at;
    Vec3 area;  // along its normal, outwards, m2
};

struct OuterSide {
    std::vector<Facet> facets;      // patches of at most `cell_m`
    std::vector<uint32_t> indices;  // of the triangles there, turned outwards
};

/// A triangle's outer side is that from which more ways lead out of the garment, for all that are joined to
/// it; where two layers lie closer than cloth is thick, the layer that is less hidden is the outer one.
OuterSide outer_side(const Soup& soup, float cell_m);

}  // namespace vfit
