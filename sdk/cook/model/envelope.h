// A single sheet of even triangles along the outer side of a garment, for what can't be simulated as it was
// modelled: with thickness, in parts, of a hundred thousand triangles.
#pragma once

#include "cook/model/pieces.h"

namespace vfit {

/// In the unit of the soup's model, with openings where the garment has them. side_m: of its triangles,
/// about. Parts that are closer to each other than that become one. VFIT_ERROR_DATA where nothing is left.
Model envelope_of(const Soup& soup, float side_m);

}  // namespace vfit
