// An animated GLB of the dressed avatar: the body as a skinned mesh whose joints move, each garment as
// morph targets, one a key frame. Right-handed, Y up, metres, as glTF 2.0 wants.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "client/client.h"
#include "client/outfit.h"

namespace vfit::tools {

struct GlbKey {
    float time_s = 0.0f;
    std::vector<glm::mat4> bone_matrices;  // world = M * rest, one a rig bone
    struct Shape {
        std::vector<glm::vec3> positions, normals;
    };
    std::vector<Shape> garments;
};

class GlbAnimation {
public:
    /// Topology, skin and rig of the avatar, topology of the garments.
    GlbAnimation(vfit_avatar avatar, const WornOutfit& outfit);
    /// One key frame of the avatar and the outfit as they are now.
    void add_key(float time_s);
    void write(const std::string& path) const;

private:
    vfit_avatar avatar_;
    const WornOutfit& outfit_;
    std::vector<vfit_rig_bone> rig_;
    std::vector<GlbKey> keys_;
};

}  // namespace vfit::tools
