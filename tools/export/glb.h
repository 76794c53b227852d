// An animated GLB of the dressed avatar: the body as a skinned mesh whose joints move, the garment as morph
// targets, one a key frame. Right-handed, Y up, metres, as glTF 2.0 wants.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

struct GlbKey {
    float time_s = 0.0f;
    std::vector<glm::mat4> bone_matrices;  // world = M * rest, one a rig bone
    std::vector<glm::vec3> garment_positions, garment_normals;
};

class GlbAnimation {
public:
    /// Topology, skin and rig of the avatar, topology of the garment.
    GlbAnimation(vfit_avatar avatar, vfit_cloth cloth);
    /// One key frame of avatar and garment as they are now.
    void add_key(float time_s);
    void write(const std::string& path) const;

private:
    vfit_avatar avatar_;
    vfit_cloth cloth_;
    std::vector<vfit_rig_bone> rig_;
    std::vector<GlbKey> keys_;
};

}  // namespace vfit::tools
