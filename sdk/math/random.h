// Random numbers that are the same on every platform: the standard library's distributions differ between its
// makers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "math/types.h"

namespace vfit {

class Random {
public:
    explicit Random(uint32_t seed) : bits_(seed) {}
    /// In [0, 1).
    float unit() { return float(bits_() >> 8) * 0x1p-24f; }
    float between(float a, float b) { return a + (b - a) * unit(); }
    /// Mean 0, deviation 1 (Box and Muller).
    float normal() {
        const float radius = std::sqrt(-2.0f * std::log(1.0f - unit()));
        return radius * std::cos(2.0f * kPi * unit());
    }

private:
    std::mt19937 bits_;
};

}  // namespace vfit
