// A smooth random field over space: values at the corners of a lattice, blended between.
#pragma once

#include <cmath>

#include "random.h"
#include "types.h"

namespace vfit::virtual_person {

/// In (-1, 1); `p` in cells of the lattice.
inline float smooth_field(uint64_t seed, const Vec3& p) {
    const Vec3 low = glm::floor(p), t = p - low, s = t * t * (3.0f - 2.0f * t);
    float sum = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 c(static_cast<float>(corner & 1), static_cast<float>(corner >> 1 & 1),
                     static_cast<float>(corner >> 2));
        const Vec3 near = glm::mix(1.0f - s, s, c);
        uint64_t key = seed;
        for (int k = 0; k < 3; ++k) key = random_bits(key, static_cast<uint64_t>(int64_t(low[k] + c[k])));
        sum += near.x * near.y * near.z * (2.0f * uniform(key, 0) - 1.0f);
    }
    return sum;
}

}  // namespace vfit::virtual_person
