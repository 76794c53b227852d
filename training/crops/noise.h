// Smooth random fields: values at the corners of a lattice, interpolated.
#pragma once

#include <cmath>
#include <cstdint>

#include "math/types.h"

namespace vfit::training {

/// In [-1, 1), by a hash of the lattice corner.
inline float corner_value(uint32_t seed, int x, int y, int z) {
    uint32_t h =
        seed ^ (uint32_t(x) * 0x8DA6B343u) ^ (uint32_t(y) * 0xD8163841u) ^ (uint32_t(z) * 0xCB1AB31Fu);
    h ^= h >> 16, h *= 0x7FEB352Du, h ^= h >> 15, h *= 0x846CA68Bu, h ^= h >> 16;
    return static_cast<float>(h >> 8) * 0x1p-23f - 1.0f;
}

inline float smooth_step(float t) { return t * t * (3.0f - 2.0f * t); }

/// In (-1, 1); p in lattice cells.
inline float smooth_noise(uint32_t seed, const Vec2& p) {
    const int x = int(std::floor(p.x)), y = int(std::floor(p.y));
    const float u = smooth_step(p.x - float(x)), v = smooth_step(p.y - float(y));
    const float a = corner_value(seed, x, y, 0), b = corner_value(seed, x + 1, y, 0);
    const float c = corner_value(seed, x, y + 1, 0), d = corner_value(seed, x + 1, y + 1, 0);
    return (a + u * (b - a)) * (1 - v) + (c + u * (d - c)) * v;
}

inline float smooth_noise(uint32_t seed, const Vec3& p) {
    const int z = int(std::floor(p.z));
    const float w = smooth_step(p.z - float(z));
    const Vec2 q(p.x, p.y);
    return smooth_noise(seed + uint32_t(z) * 0x9E3779B9u, q) * (1 - w) +
           smooth_noise(seed + uint32_t(z + 1) * 0x9E3779B9u, q) * w;
}

}  // namespace vfit::training
