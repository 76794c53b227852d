// A character's own file with a motion in it: meshes, materials and textures go through as they are, the
// nodes of its bones get key frames.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

class CharacterAnimation {
public:
    /// The avatar must come from that file.
    CharacterAnimation(vfit_avatar avatar, std::string file) : avatar_(avatar), file_(std::move(file)) {}
    /// The avatar as it is now.
    void add_key(float time_s);
    size_t key_count() const { return keys_.size(); }
    void write(const std::string& path) const;

private:
    struct Key {
        float time_s;
        std::vector<glm::mat4> bone_matrices;
    };
    vfit_avatar avatar_;
    std::string file_;
    std::vector<Key> keys_;
};

}  // namespace vfit::tools
