// A layer below a garment that is put on: it grows from the bones that it is skinned to, to where it hangs.
// Curtains below its hems push outwards what of the garment reaches further down, so that it is not caught
// inside.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

class GrownBelow {
public:
    /// Of a garment with that number of vertices, three indices a triangle.
    GrownBelow(size_t vertices, std::span<const uint32_t> indices);

    /// The garment's vertices and triangles, then those of the curtains.
    size_t vertex_count() const { return vertices_ + kRows * drops_.size(); }
    const std::vector<uint32_t>& indices() const { return indices_; }

    /// share: fraction of the way, from 0 to 1, from the bones (within: one position a garment vertex) to
    /// where the garment hangs. A border that does not point down has no curtain: its positions are not
    /// finite.
    void place(std::span<const Vec3> hangs, std::span<const Vec3> within, float share,
               std::vector<Vec3>& places) const;

private:
    static constexpr size_t kRows = 10;
    struct Drop {                // of a border's vertex
        uint32_t vertex, inner;  // and the corner off the border of a triangle there
        uint32_t line;
    };
    size_t vertices_;
    std::vector<uint32_t> indices_;
    std::vector<Drop> drops_;
    uint32_t lines_ = 0;
};

}  // namespace vfit
