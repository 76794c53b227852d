// What covers a body: clothes and shoes as offsets of the skin; shirts that fall straight, skirts and coats
// as a shell about the legs; the cloth between the legs of trousers; hair; things held. Rough shapes: they
// teach the network what not to rely on.
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
    /// A shell about both legs, from above the hips down to its hem.
    struct Shell {
        float hem = 0.0f;                    // share of the leg's length below the hips
        float side_m = 0.0f, deep_m = 0.0f;  // beyond the legs' axes
        float taper = 0.0f;                  // what of both is lost towards the ankles
        float flare = 1.0f;                  // at the ankles
    };

    void fall_straight(const Avatar& avatar, Random& random);
    void straighten_legs(const Avatar& avatar, Random& random);
    void add_shell(const Avatar& avatar, const Shell& shell, Mesh& out) const;
    void add_seat(const Avatar& avatar, Mesh& out) const;
    void add_hair(const Avatar& avatar, Mesh& out) const;
    void add_held_thing(const Avatar& avatar, Random& random, Mesh& out) const;

    std::vector<float> offset_m_;  // along the normal, one a vertex
    std::vector<Shell> shells_;
    float seat_ =
        0.0f;  // how far down the cloth between the legs reaches, share of the leg's length; 0: none
    bool hair_;
    float hair_length_m_, hair_width_m_;
};

}  // namespace vfit::training
