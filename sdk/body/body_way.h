// How far the body moves in one step.
#pragma once

namespace vfit {

/// Displacements of the parts of the body that carry cloth: the least; the greatest by the rigid motion that
/// fits all parts best; the greatest relative to that motion.
struct BodyWay {
    float min_m = 0.0f, whole_m = 0.0f, limb_m = 0.0f;
};

}  // namespace vfit
