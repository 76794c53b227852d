// What covers a body: clothes and shoes as offsets of the skin, skirts and coats as a shell about the legs, hair,
// and things held. Rough shapes: they teach the network what not to rely on.
#pragma once

#include "avatar/avatar.h"
#include "body/mesh.h"
#include "random.h"

namespace vfit::training {

class Outfit {
public:
    Outfit(const Avatar& avatar, Random& random);

    /// The dressed surface of the posed avatar, world space; indices and positions only.
    void dress(const Avatar& avatar, Random& random, Mesh& out) const;

private:
    void add_skirt(const Avatar& avatar, Mesh& out) const;
    void add_hair(const Avatar& avatar, Mesh& out) const;
    void add_held_thing(const Avatar& avatar, Random& random, Mesh& out) const;

    std::vector<float> offset_m_;  // along the normal, one a vertex
    bool skirt_, hair_;
    float hem_, flare_, skirt_ease_m_;  // hem: share of the leg's length below the hips
    float hair_length_m_, hair_width_m_;
};

}  // namespace vfit::training
