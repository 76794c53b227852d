// The paper's six outfits (Fig. 14), of vfit's own designs, and an avatar that wears one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "client/client.h"
#include "picture/render.h"

namespace vfit::tools {

/// Garments from the skin outwards.
struct Outfit {
    std::string name;
    vfit_sex sex;
    std::vector<std::string> garments;
};

/// Three of women, then three of men.
const std::vector<Outfit>& outfits();
const Outfit& outfit(std::string_view name);

/// Several garments over each other on the avatar's skin, as they come when they are made to measure.
class Worn {
public:
    Worn(vfit_context context, vfit_avatar avatar, const Outfit& outfit);

    /// Dresses the avatar anew in the pose that it has now, and lets the garments come to rest.
    void put_on(float rest_s);
    void step(float dt);

    /// Avatar and garments in the garments' own colours; skin that one of them hides is left out.
    std::vector<RenderMesh> meshes() const;

    /// How each garment fares, by its name: the stretch of its threads, and what its upper edge sank by since
    /// it was put on.
    Json report() const;

private:
    struct Piece {
        std::string name;
        Garment garment;
        Cloth cloth;
        float top_m = 0.0f;  // of the upper edge when it was put on
    };
    vfit_avatar avatar_;
    std::vector<Piece> pieces_;
    std::vector<uint32_t> seen_skin_;
};

}  // namespace vfit::tools
