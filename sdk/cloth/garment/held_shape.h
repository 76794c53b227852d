// HeldShape: what holds a garment goes with the skin, but does not stretch as far as skin does. Above a
// raised arm the skin of the model gets up to twice as long; cloth that followed it would be torn.
//
// That is so of an area, as a bodice that lies on the skin. A band, as on shoulders or at the waist, stays
// where the skin carries it: the cloth beside it gives way, and a band that is drawn aside pulls on its
// sleeves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

/// The edges between the vertices that hold a garment, with their lengths on the body at rest.
class HeldShape {
public:
    HeldShape() = default;
    /// held: vertices; indices: three a triangle; rest: one a vertex.
    HeldShape(std::span<const uint32_t> held, std::span<const uint32_t> indices, std::span<const Vec3> rest);

    /// Draws towards each other what the skin carries further apart than cloth goes. places: one a vertex of
    /// the garment; of these, only those that hold it move. Does not allocate.
    void keep_lengths(std::span<Vec3> places) const;

private:
    struct Edge {
        uint32_t a, b;
        float longest_m;
    };
    std::vector<Edge> edges_;
};

}  // namespace vfit
