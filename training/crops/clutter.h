// What is no person: things that stand on the floor like one (chairs, racks with coats, boxes, plants) and
// pieces of rooms.
#pragma once

#include "body/mesh.h"
#include "random.h"

namespace vfit::training {

/// One to three things on the floor about the world's origin, metres.
void random_clutter(Random& random, Mesh& out);

}  // namespace vfit::training
