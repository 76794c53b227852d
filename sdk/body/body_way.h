// How far the body moves in one step.
#pragma once

namespace vfit {

/// Displacements of the parts of the body that carry cloth.
struct BodyWay {
    float min_m = 0.0f, max_m = 0.0f;
};

}  // namespace vfit
