// Random draws of one training crop: everything about it follows from (seed, index).
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

#include "math/types.h"

namespace vfit::training {

class Random {
public:
    /// The seed is mixed before the index is added and once more after, so that neither neighbouring seeds
    /// nor neighbouring indices give the same sequence a step apart.
    Random(uint64_t seed, uint64_t index) : state_(seed) {
        state_ = bits() + index;
        state_ = bits();
    }

    /// SplitMix64 (Steele, Lea, Flood 2014).
    uint64_t bits() {
        uint64_t z = state_ += 0x9E3779B97F4A7C15ull;
        z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
        z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    float unit() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
    float between(float low, float high) { return low + (high - low) * unit(); }
    bool chance(float probability) { return unit() < probability; }
    uint32_t below(uint32_t count) { return static_cast<uint32_t>(unit() * static_cast<float>(count)); }
    float normal(float mean, float sd) {
        const float radius = std::sqrt(-2.0f * std::log(1.0f - unit()));  // Box and Muller 1958
        return mean + sd * radius * std::cos(2.0f * kPi * unit());
    }
    /// The index of one of the weights, drawn in proportion to them.
    size_t pick(std::initializer_list<float> weights) {
        float sum = 0.0f;
        for (const float w : weights) sum += w;
        float left = unit() * sum;
        size_t i = 0;
        for (const float w : weights) {
            left -= w;
            if (left < 0.0f) return i;
            ++i;
        }
        return weights.size() - 1;
    }
    Vec3 direction() {
        const float y = between(-1.0f, 1.0f), turn = between(0.0f, 2.0f * kPi), r = std::sqrt(1.0f - y * y);
        return {r * std::cos(turn), y, r * std::sin(turn)};
    }

private:
    uint64_t state_;
};

}  // namespace vfit::training
