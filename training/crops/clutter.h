// Things that are no person but stand on the floor like one: chairs, racks with coats, boxes, plants,
// columns.
#pragma once

#include "body/mesh.h"
#include "random.h"

namespace vfit::training {

/// On the floor about the world's origin, metres.
void random_clutter(Random& random, Mesh& out);

}  // namespace vfit::training
