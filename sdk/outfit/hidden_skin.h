// Skin that nobody sees under a garment: engines leave its triangles out, and nothing can shine through.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

/// Both at rest; three indices a triangle.
struct Covered {
    std::span<const Vec3> body;
    std::span<const uint32_t> body_indices;
    std::span<const Vec3> garment;
    std::span<const uint32_t> garment_indices;
};

/// One a body triangle, 1: the garment alone, without arms or other limbs that move away, hides it, and all
/// skin nearer than margin_m, from all who do not look up under it by more than 45 degrees.
std::vector<uint8_t> hidden_triangles(const Covered& covered, float margin_m, Jobs& jobs);

}  // namespace vfit
