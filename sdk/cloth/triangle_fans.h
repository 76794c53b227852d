// Which triangles meet at each vertex of a mesh, and where on one of them a point is nearest.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

class TriangleFans {
public:
    TriangleFans(size_t vertices, std::span<const uint32_t> indices);
    /// Numbers of the triangles about that vertex.
    std::span<const uint32_t> of(uint32_t vertex) const {
        return {triangles_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
    }

private:
    std::vector<uint32_t> first_, triangles_;
};

/// Weights of the corners at the nearest point of the triangle (Ericson, Real-Time Collision Detection, 5.1.5).
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace vfit
