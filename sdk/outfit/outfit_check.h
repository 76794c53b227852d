// Which surfaces of an outfit cross: garments with themselves, with the skin, and with each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/crossings.h"
#include "core/jobs.h"
#include "outfit/worn_garment.h"

namespace vfit {

/// Two surfaces of which triangles cross.
struct SurfaceCrossing {
    enum class With : uint8_t { itself, skin, garment, prop };
    With with;
    uint32_t garment, other;  // numbers in the outfit; other: of With::garment or among the garment's props,
                              // else as garment
    uint32_t pair_count;      // of triangles
    TrianglePair first;       // a triangle of the garment, one of the other surface
};

/// Of the last finished steps. Every pair of triangles is tested, except pairs that share a vertex: an empty
/// list proves that none cross. By garment: with itself, with the skin, with later garments, with its props.
/// The skin is that of the pose of the garment's step. All are worn by one body, and none is named twice.
std::vector<SurfaceCrossing> find_crossings(std::span<const WornGarment* const> outfit, Jobs& jobs);

}  // namespace vfit
