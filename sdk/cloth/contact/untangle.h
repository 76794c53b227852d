// Surfaces that go through each other, moved apart without knowing how they came to: the line along which
// they cross is made shorter (Volino and Magnenat-Thalmann 2006, "Resolving surface collisions through
// intersection contour minimization").
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/contact/triangle_groups.h"

namespace vfit {

class Untangle {
public:
    /// Moves the vertices of triangles that cross, but the fixed ones, by step_m at most. indices: three a
    /// triangle, counter-clockwise. Returns the vertices of those triangles. Does not allocate once it has
    /// met as many.
    std::span<const uint32_t> move(std::span<const TrianglePair> crossed, std::span<const uint32_t> indices,
                                   std::span<const uint8_t> is_fixed, float step_m, std::span<Vec3> places);

private:
    void shorten(const uint32_t (&own)[3], const uint32_t (&other)[3], std::span<const Vec3> places);

    std::vector<Vec3> ways_;  // of each vertex; zero between calls
    std::vector<uint32_t> vertices_;
};

}  // namespace vfit
