// How a character stands and walks: cloth that goes with its bones must not cross its skin there.
#pragma once

#include <span>
#include <vector>

#include "avatar/avatar_source.h"
#include "avatar/character_body.h"
#include "avatar/skin.h"
#include "math/types.h"

namespace vfit {

/// As large as the body inside the character.
struct Stand {
    std::vector<Mat4> matrices;  // one a bone of the character, from its rest mesh
    std::vector<Vec3> skin;      // the character's vertices
};

/// The linear blend of the bones that carry a vertex.
Mat4 blended(const SkinBones& bones, const SkinWeights& weights, std::span<const Mat4> matrices);

/// The first is that of the body, in which garments are simulated.
std::vector<Stand> usual_stands(const AvatarSource& character, const CharacterBody& body);

}  // namespace vfit
