// The skeleton of a BVH file as a character's file, so that its bones are found as those of characters are.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "client/bvh_file.h"

namespace vfit::tools {

/// A GLB of the joints as they stand in `worlds`, upright along Y or along Z, with a small tetrahedron of
/// that size at each, carried by it.
std::string skeleton_glb(const BvhFile& file, const std::vector<glm::mat4>& worlds, bool is_z_up, float size);

}  // namespace vfit::tools
