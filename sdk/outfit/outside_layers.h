// Moves a garment outside of others that it is put over, at once: each vertex goes away from the bones that
// carry it, as far as the garments below reach there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

/// A garment, and of each vertex the point within its bones (Carry::on_axes).
struct AboutBones {
    std::span<const Vec3> positions;
    std::span<const uint32_t> indices;
    std::span<const Vec3> on_bones;
};

/// The positions of `outer`, outside of all of `inner` by clearance_m where these are met.
std::vector<Vec3> outside_of(std::span<const AboutBones> inner, const AboutBones& outer, float clearance_m);

}  // namespace vfit
