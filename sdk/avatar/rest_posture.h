// The posture in which a character is at rest. A file's scene may stand in any pose of an animation; what its
// skin was bound in is then the posture that it was made in.
#pragma once

#include <vector>

#include "avatar/gltf_document.h"
#include "avatar/humanoid_map.h"

namespace vfit {

/// World transforms of all nodes: those of the scene, or of the posture that the skin is bound in where the
/// legs stand straighter there. VRM says that the scene is at rest. Without a place of its own: the bound
/// posture stands anywhere.
std::vector<Mat4> rest_posture(const GltfDocument& document, const HumanoidMap& map);

}  // namespace vfit
