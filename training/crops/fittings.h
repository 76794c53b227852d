// What rooms are fitted with: curtains, window frames, pipes, shelves, pieces of wall, tables with chairs.
#pragma once

#include "body/mesh.h"
#include "random.h"

namespace vfit::training {

/// About the world's origin, metres; high ones hang or lean where they do in a room.
void random_fitting(Random& random, Mesh& out);

}  // namespace vfit::training
