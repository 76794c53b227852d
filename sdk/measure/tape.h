// Body measures taken on a mesh as a tailor takes them: sections, tape girths, lengths between landmarks.
// These are the true values of a body whose mesh is known.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "frame/body.h"
#include "math/types.h"
#include "measure/measurement.h"

namespace vfit {

/// A standing body in one posture: metres, Y up, facing +Z, its left on +X.
struct TapeBody {
    std::span<const Vec3> positions;     // closed surface
    std::span<const uint32_t> indices;   // three a triangle
    std::span<const BodyPart> parts;     // one a vertex at least
    Body joints;                         // in the space of the positions
    vfit_sex sex = VFIT_SEX_UNKNOWN;     // unknown: the chest is measured as a man's
};

/// The two postures that the definitions ask for; both views may be of the same mesh where the second is not
/// to be had (shoulder_breadth_m then is that of the first).
struct TapePostures {
    TapeBody arms_out;   // upper arms clear of the trunk, feet about 0.25 m apart
    TapeBody arms_down;  // upper arms 5 degrees from the vertical
};

/// Every measure of measure_keys.h that a mesh can tell, sigma 0. VFIT_ERROR_DATA where the mesh or a joint
/// that a landmark needs is missing, or a section that must exist does not.
std::vector<Measurement> tape_measures(const TapePostures& body);

}  // namespace vfit
