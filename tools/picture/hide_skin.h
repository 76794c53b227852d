// Skin that lies under cloth is left out of pictures, as engines do: colliders are spheres and capsules, and
// a hip that is rounder than they are would shine through.
#pragma once

#include <vector>

#include "picture/render.h"

namespace vfit::tools {

/// The body's triangles without those under the cloth. `coverable`: one a body vertex, 0 for arms and head,
/// which only come near.
std::vector<uint32_t> visible_triangles(const RenderMesh& body, const RenderMesh& cloth,
                                        const std::vector<uint8_t>& coverable);

}  // namespace vfit::tools
