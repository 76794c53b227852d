// Body measures taken on a mesh as a tailor takes them: sections, tape girths, lengths between landmarks.
// These are the true values of a body whose mesh is known.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "anthropometry/measurement.h"
#include "body/body_model.h"
#include "frame/body.h"
#include "math/types.h"

namespace vfit {

/// A standing body in one posture: metres, Y up, facing +Z, its left on +X.
struct TapeBody {
    std::span<const Vec3> positions;    // closed surface
    std::span<const uint32_t> indices;  // three a triangle
    std::span<const BodyPart> parts;    // one a vertex at least
    Body joints;                        // in the space of the positions
    vfit_sex sex = VFIT_SEX_UNKNOWN;    // unknown: the chest as a man's
};

/// The postures that the definitions ask for. The same mesh in three postures, or, where only one is to be
/// had, three times the same: stature_m is then that of the stance, shoulder_breadth_m that of the arms.
struct TapePostures {
    TapeBody arms_out;       // upper arms clear of the trunk, feet about 0.25 m apart: all but the two below
    TapeBody arms_down;      // upper arms 5 degrees from the vertical: bideltoid breadth
    TapeBody feet_together;  // stature
};

/// Every length of measure_keys.h (underbust_girth_m of women only), sigma 0, in its order. VFIT_ERROR_DATA
/// where a mesh is broken, a joint that a landmark needs is missing, or the body has not the form of a person
/// (legs that never part).
std::vector<Measurement> tape_measures(const TapePostures& body);

}  // namespace vfit
