// Sews placed panels together on a body and lets the garment fall to rest.
#pragma once

#include "cook/body/cook_body.h"
#include "cook/drape/placement.h"
#include "cook/drape/settle.h"
#include "cook/sew/sewn.h"

namespace vfit {

/// Positions and flags are one a sewn vertex. stance: of the body while it is sewn. VFIT_ERROR_DATA, naming
/// the stitch, where a seam does not close.
Draped drape(const Pattern& pattern, const SewnMesh& mesh, const FabricMaterial& material,
             const CookBody& body, const Stance& stance, const Placement& placement,
             const DrapeSettings& settings, Jobs& jobs);

}  // namespace vfit
