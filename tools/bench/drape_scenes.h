// Cloths made of numbers, for figures of the solver: sheets, strips, tubes, and what is judged of them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "math/types.h"

namespace vfit::bench {

/// Sheets of triangles, each `rows` x `columns` vertices, with alternating diagonals.
struct Sheets {
    std::vector<Vec3> positions;
    std::vector<Vec2> uvs;  // metres on the flat cloth
    std::vector<uint32_t> indices;
    std::vector<uint8_t> simulated;

    /// One more: corner, step from column to column, step from row to row.
    void add(uint32_t rows, uint32_t columns, const Vec3& corner, const Vec3& across, const Vec3& down);
    std::shared_ptr<const Fabric> cook(const FabricMaterial& material) const;
};

/// A wool-like weave of 0.2 kg/m2 that is used where a figure does not depend on the fabric.
FabricMaterial plain_weave();

Collider ball(const Vec3& center, float radius);
Collider rod(const Vec3& a, const Vec3& b, float radius);

/// The least distance of a vertex from a triangle that is further than `along_m` from it on the flat cloth,
/// or on another piece of it.
float least_spacing(std::span<const Vec3> positions, std::span<const uint32_t> indices,
                    std::span<const Vec3> flat, float along_m);

}  // namespace vfit::bench
