// The triangles of a mesh by their place along a line: those that a plane across it cuts lie side by side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

class TriangleLayers {
public:
    /// Of the triangles that reach into low to high, in metres from the origin along the direction (of length
    /// 1). VFIT_ERROR_DATA where that is not finite.
    TriangleLayers(std::span<const Vec3> positions, std::span<const uint32_t> indices, const Vec3& origin,
                   const Vec3& direction, float low, float high);

    /// Indices of all triangles that reach that place between low and high, and of few others.
    std::span<const uint32_t> at(float place) const;

private:
    size_t layer_of(float place) const;

    float low_, high_, thickness_;
    std::vector<uint32_t> first_;    // of each layer, and the end of the last one
    std::vector<uint32_t> indices_;  // a triangle stands in every layer that it reaches into
};

}  // namespace vfit
