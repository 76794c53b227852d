// Skin that a garment hides: engines leave its triangles out, so that it cannot show through the cloth.
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
    // Skin hides skin, too, where a garment does most: through the gap between a wrist and its cuff no
    // person sees an elbow. For bodies that stand with their limbs apart.
    bool skin_hides = false;
};

/// One flag a body triangle. 1: it, and all skin nearer than margin_m, is hidden by the garment alone (arms
/// and other limbs move away) from every direction that looks up by at most 45 degrees.
std::vector<uint8_t> hidden_triangles(const Covered& covered, float margin_m, Jobs& jobs);

/// One a body vertex: how much of what it looks at, up and down too, is the garment; 0 to 1.
std::vector<float> cover_of(const Covered& covered, Jobs& jobs);

}  // namespace vfit
