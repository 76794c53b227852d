// Where the panels are held about a body before they are sewn.
#pragma once

#include <vector>

#include "cook/body/body_outline.h"
#include "cook/drape/settle.h"
#include "cook/pattern/pattern.h"
#include "cook/sew/sewn.h"

namespace vfit {

struct Placement {
    std::vector<Vec3> places;  // one a panel vertex
    HangsOn hangs_on = HangsOn::nothing;
    float raised_m = 0.0f;  // by which all panels were to fit the body
    float lifted_m = 0.0f;  // and by which trousers were beside that, to be sewn above the feet
    Hold hold;  // of sewn vertices: at the shoulder seams, or at the upper edge, which is worn at band_m
    float band_m = 0.0f;
};

/// Whether a part of it goes about each leg.
bool has_legs(const Pattern& pattern, const BodyOutline& outline);
/// Whether a panel is placed about an arm.
bool has_sleeves(const Pattern& pattern, const BodyOutline& outline);

/// The panels as the pattern places them, raised or lowered so that its shoulder seams lie on the body's
/// shoulders (else its upper border where it is worn, if its crotch is not above the body's there), then each
/// moved outwards until it is clear of the body. VFIT_ERROR_DATA names the panel that cannot be.
Placement place_panels(const Pattern& pattern, const SewnMesh& mesh, const BodyOutline& outline,
                       const MeshQuery& skin);

}  // namespace vfit
