// The same sheets with even triangles, for what is modelled with triangles that are too small, too long or
// too thin to be simulated well.
#pragma once

#include "cook/model/pieces.h"

namespace vfit {

/// In the unit of the pieces' model, with the same openings. side_m: of its triangles, about (Botsch and
/// Kobbelt 2004, "A remeshing approach to multiresolution modeling").
Model with_even_triangles(const Pieces& pieces, float side_m);

}  // namespace vfit
