// How far the body moves in one step.
#pragma once

namespace vfit {

/// Displacements of the parts of the body that carry cloth: the least of all, the greatest of the body as a
/// whole, which moves as one, and the greatest of a limb against that.
struct BodyWay {
    float min_m = 0.0f, whole_m = 0.0f, limb_m = 0.0f;
};

}  // namespace vfit
