// The collision proxy of a hand: a mitten. Between fingers, and between a thumb and the palm, the hem of a
// sleeve would hook.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

struct Mitten {
    std::vector<Vec3> places;
    std::vector<uint32_t> goes_with;  // one a place: the point of the hand whose bones carry it
    std::vector<uint32_t> indices;    // three a triangle, counter-clockwise from outside
};

/// Around the points of a hand, in metres: its sections across the hand are convex. Open towards the forearm,
/// which lies that way (unit length).
Mitten mitten_around(std::span<const Vec3> hand, const Vec3& to_forearm);

}  // namespace vfit
