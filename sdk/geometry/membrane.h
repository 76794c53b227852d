// Shifts of a mesh's vertices that differ little from neighbour to neighbour.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

class Membrane {
public:
    /// Three indices a triangle.
    Membrane(size_t vertices, std::span<const uint32_t> indices);

    std::span<const uint32_t> neighbours(size_t vertex) const {
        return std::span(list_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
    }

    /// Minimises the sum of weight * |shift - wanted|^2 over vertices and of stiffness * |shift - shift|^2
    /// over edges, by Gauss and Seidel from the wanted shifts on. A vertex without neighbours and weight
    /// keeps its own.
    std::vector<Vec3> even(std::span<const Vec3> wanted, std::span<const float> weights, float stiffness,
                           int rounds) const;

private:
    std::vector<uint32_t> first_, list_;
};

}  // namespace vfit
