// Garments put on a character for good: simulated on a body inside the character, bound to the character's
// own bones, with the skin below them left out. Offline.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "avatar/character.h"
#include "avatar/character_body.h"
#include "body/body_model.h"
#include "cloth/fabric/fabric_library.h"
#include "cloth/garment/garment.h"
#include "core/jobs.h"

namespace vfit {

struct RefitRequest {
    vfit_sex sex =
        VFIT_SEX_UNKNOWN;  // of the body that is brought into the character; unknown: the garment's
    std::vector<std::string> taken_off;  // names of the character's meshes or materials that are left out
    float margin_m = 0.005f;             // of skin kept at the edges of what the garments hide
};

/// A garment as it is drawn, in the space of the character's rest mesh.
struct RefittedGarment {
    std::vector<Vec3> positions, normals;
    std::vector<SkinBones> bones;  // of the character
    std::vector<SkinWeights> weights;
    uint32_t skin_crossings = 0, self_crossings = 0;  // pairs of triangles, where it was simulated
    float strain_p99 = 0.0f;
};

struct Refitted {
    std::vector<RefittedGarment> garments;
    std::vector<uint8_t> hidden;  // one a triangle of the character: below the garments, or taken off
    struct Outside {
        std::string mesh, material;
        float by_m;  // out of the body that the garments lie on
    };
    std::vector<Outside> outside;  // what the character has on that the garments cannot go over
    float scale = 1.0f;            // CharacterBody::scale
};

/// garments: the innermost first. VFIT_ERROR_ARGUMENT for a name in taken_off that the character lacks,
/// VFIT_ERROR_NOT_WEARABLE where a garment does not close.
Refitted refit(const Character& character, std::span<const Garment> garments,
               const std::shared_ptr<const BodyModel>& model, const FabricLibrary& fabrics,
               const RefitRequest& request, Jobs& jobs);

}  // namespace vfit
