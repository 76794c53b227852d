// The body model inside a character: the same surface and bones as all bodies of the model have, brought to
// the character's proportions, so that it can wear what was made for them.
#pragma once

#include <vector>

#include "avatar/avatar_source.h"
#include "body/body_model.h"
#include "math/types.h"

namespace vfit {

struct CharacterBody {
    // The body, of the level of detail 0, in the model's own posture, around the skin of the character.
    AvatarSource source;
    // Metres of that body in a metre of the character: its trunk is as long as that of the default body.
    float scale = 1.0f;
    // One a bone of the character: from its rest mesh to where the body stands.
    std::vector<Mat4> from_rest;
    std::vector<Vec3> skin;  // the character's vertices there
    // How far the character's skin lies outside of the body. One a vertex of the character; 0: inside, or not
    // looked at (hair, hands, face).
    std::vector<float> outside_m;
    std::vector<float> of_head;  // one a vertex of the character: how far its head carries it, 0 to 1
    // Which of the character's bones carry each vertex of the body, as they carry its own skin there.
    std::vector<SkinBones> skin_bones;
    std::vector<SkinWeights> skin_weights;
};

/// `left_out`: empty, or a flag a triangle of the character: 1, it is not worn over.
CharacterBody body_in(const AvatarSource& character, const std::shared_ptr<const BodyModel>& model,
                      vfit_sex sex, std::span<const uint8_t> left_out = {});

}  // namespace vfit
