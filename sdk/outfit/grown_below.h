// A garment as it is worn over by another that is put on: it grows from the bones that carry it to where it
// hangs. Below its hems hang curtains, so that what reaches further down is taken outwards too, and not
// caught inside.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

class GrownBelow {
public:
    /// Of a garment of so many vertices, three indices a triangle.
    GrownBelow(size_t vertices, std::span<const uint32_t> indices);

    /// The garment's vertices and triangles, then those of the curtains.
    size_t vertex_count() const { return vertices_ + kRows * drops_.size(); }
    const std::vector<uint32_t>& indices() const { return indices_; }

    /// From the bones (place within them, one a garment vertex) to where the garment hangs: 0 to 1 of the
    /// way. Where a border does not point down it has no curtain: places that are not finite.
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
