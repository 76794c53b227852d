// Random numbers by counter: the value for (key, index) does not depend on what was drawn before, so that a
// pixel's noise is the same whatever order the pixels are visited in.
#pragma once

#include <cstdint>

namespace vfit::virtual_person {

/// 64 well-mixed bits of (key, index): the output function of SplitMix64 (Steele, Lea, Flood 2014) at the
/// index-th step of the stream that starts at key.
inline uint64_t random_bits(uint64_t key, uint64_t index) {
    uint64_t z = key + (index + 1) * 0x9E3779B97F4A7C15ull;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
}

/// A key of its own for one frame of one seed.
inline uint64_t frame_key(uint64_t seed, uint64_t frame) {
    return random_bits(random_bits(0x766669742D763031ull, seed), frame);
}

/// In [0, 1).
inline float uniform(uint64_t key, uint64_t index) {
    return static_cast<float>(random_bits(key, index) >> 40) * 0x1p-24f;
}

/// Quantiles of the standard normal distribution, at the middle of each step: uniform bits become one normal
/// number by a look-up. Cut at 4 SD, and small enough to stay in a core's cache.
inline constexpr uint32_t kQuantileCount = 1u << 14;
const float* normal_quantiles();

}  // namespace vfit::virtual_person
