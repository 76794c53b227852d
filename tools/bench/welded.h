// Meshes as they are judged: copies of a vertex at seams are one.
#pragma once

#include <cstdint>
#include <vector>

#include "client/client.h"
#include "math/types.h"

namespace vfit::tools {

/// A mesh whose vertices at one place are one; triangles in the order of the frame's.
struct Welded {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
};
Welded mesh_of(vfit_avatar avatar);
Welded mesh_of(vfit_cloth cloth);

}  // namespace vfit::tools
