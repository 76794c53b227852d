// What is no person: things that stand on the floor like one (chairs, racks with coats, boxes, plants) and
// pieces of rooms.
#pragma once

#include "body/mesh.h"
#include "random.h"

namespace vfit::training {

/// One to three things on the floor about the world's origin, metres.
void random_clutter(Random& random, Mesh& out);
/// One thing that a room is fitted with: a curtain, a window frame, pipes, a shelf, a piece of wall, a seat,
/// a table with chairs; high ones hang or lean where they do in a room.
void add_fitting(Random& random, Mesh& out);

}  // namespace vfit::training
