// What an avatar is made of: a rest mesh, its bones and its skin, from the body model or from a character's
// file.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "avatar/rig.h"
#include "avatar/skin.h"
#include "body/body_model.h"
#include "body/mesh.h"

namespace vfit {

struct AvatarSource {
    Mesh rest;  // render vertices, soles on y = 0
    std::shared_ptr<const BodyTopology> topology;
    std::vector<AvatarBone> bones;
    std::vector<SkinBones> skin_bones;      // one a render vertex
    std::vector<SkinWeights> skin_weights;  // sum to 1
    // A closed surface of naked skin: it can be measured, and its inside is known.
    bool is_body = true;
};

/// A body of the model at a level of detail; `shape` and `scale` as Avatar's constructor says.
AvatarSource body_source(const std::shared_ptr<const BodyModel>& model, uint32_t detail, vfit_sex sex,
                         std::span<const float> shape, const Vec2& scale);

}  // namespace vfit
