// How far hanging cloth has come down because it is stretched: by its weight, and by what few sub-steps leave
// of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "outfit/garment_fit.h"

namespace vfit {

/// What stretched it.
struct Sagging {
    float gravity_m_s2 = 9.81f;  // downwards
    float substep_s = 0.0f;      // 0: it has not been stepped
};

/// Where the vertices would be, were the cloth as long as it is cut wherever it runs down, but for what its
/// weight does not explain: that stretch is held by the body, as at an armhole below a lifted arm. What is
/// not simulated stays. simulated: flags, one a vertex.
std::vector<Vec3> without_sag(const UnposedGarment& garment, std::span<const uint8_t> simulated,
                              const Sagging& sagging);

}  // namespace vfit
