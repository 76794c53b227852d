// The sag of hanging cloth: how far its strain, from its weight and from too few sub-steps, lets it come
// down.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "outfit/garment_fit.h"

namespace vfit {

/// The causes of the strain.
struct Sagging {
    float gravity_m_s2 = 9.81f;  // downwards
    float substep_s = 0.0f;      // 0: it has not been stepped
};

/// Positions of the vertices if the cloth were as long as it is cut, wherever it runs down. Strain that its
/// weight does not explain remains: the body holds it, as at an armhole below a lifted arm. Pinned vertices
/// stay. simulated: flags, one a vertex.
std::vector<Vec3> without_sag(const UnposedGarment& garment, std::span<const uint8_t> simulated,
                              const Sagging& sagging);

}  // namespace vfit
