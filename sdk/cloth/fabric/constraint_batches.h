// Constraints in batches of kLanes that share no particle, and batches in an order in which those next to
// each other share none either, where that can be.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cloth/base/particle.h"

namespace vfit {

/// A constraint and its particles; one of two names them twice.
struct Bond {
    std::array<uint32_t, 4> particles;
    uint32_t index;  // of the constraint

    static Bond of_two(uint32_t a, uint32_t b, uint32_t index) { return {{a, b, a, b}, index}; }
};
std::vector<std::vector<Bond>> batch_up(std::vector<Bond> bonds);

}  // namespace vfit
