// Cloth that is stretched beside an obstacle, which hooks it or pinches it against the body. Such an obstacle
// passes through the cloth for a while: otherwise the cloth would be stretched without end.
#pragma once

#include <cstddef>
#include <vector>

#include "cloth/contact/length_limit.h"
#include "math/types.h"
#include "outfit/cloth_piece.h"

namespace vfit {

inline constexpr float kPasses_s = 0.3f;  // at least

/// An edge beside an obstacle would get clearly longer than it may be: the obstacle holds the cloth. point(i)
/// is where one of that many points of the obstacle is; counts(v): it meets that vertex.
template <typename Point, typename Counts>
bool is_held(const ClothPiece& cloth, size_t points, Point&& point, Counts&& counts) {
    constexpr float kBeside_m = 0.02f;  // between the edge and a point
    constexpr float kHeld = LengthLimit::kMaxContactStrain + 0.1f;
    const std::span<const float> strains = cloth.edge_strain();
    const std::span<const Vec3> places = cloth.positions();
    for (size_t i = 0; i < strains.size(); ++i) {
        if (strains[i] <= kHeld) continue;
        const ClothPiece::Edge edge = cloth.edge(i);
        if (!counts(edge.a)) continue;
        const Vec3 &a = places[edge.a], &b = places[edge.b];
        for (size_t k = 0; k < points; ++k) {
            const Vec3 p = point(k);
            const float along = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0f, 1.0f);
            if (glm::distance(p, glm::mix(a, b, along)) < kBeside_m) return true;
        }
    }
    return false;
}

}  // namespace vfit
