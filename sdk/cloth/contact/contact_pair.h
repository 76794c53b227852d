// A vertex and a triangle, or two edges: the closest points of the two, and when they touch on their way.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "math/types.h"

namespace vfit {

enum class PairKind : uint8_t {
    vertex_face,  // vertex; three corners
    edge_edge     // two ends; two ends
};

/// Closest points of the two primitives.
struct ClosestPoints {
    std::array<float, 4> weights;  // of the four vertices: first point minus second; their sum is 0
    Vec3 way;                      // from the second point to the first

    /// Both points lie inside of their triangle or edges, not on a border.
    bool is_inside(PairKind kind) const;
};
ClosestPoints closest_points(PairKind kind, const std::array<Vec3, 4>& at);

/// When the two first come closer than tolerance_m on linear ways, 0..1; none: they do not. Finds it among
/// the times at which the four vertices lie in one plane (Provot 1997), and at the end. weights: of the
/// closest points then.
std::optional<float> first_touch(PairKind kind, const std::array<Vec3, 4>& from,
                                 const std::array<Vec3, 4>& to, float tolerance_m,
                                 std::array<float, 4>& weights);

}  // namespace vfit
