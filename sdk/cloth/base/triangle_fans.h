// Which triangles meet at each point of a mesh, and where on one of them a place is nearest.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

class TriangleFans {
public:
    /// The other two corners of a triangle, in its order.
    struct Corners {
        uint32_t second, third;
    };

    TriangleFans() = default;
    /// Three points a triangle, each less than `points`.
    TriangleFans(size_t points, std::span<const uint32_t> indices);

    std::span<const Corners> of(uint32_t point) const {
        return {corners_.data() + first_[point], first_[point + 1] - first_[point]};
    }
    const uint32_t* first() const { return first_.data(); }  // corners of each point, and the end
    const Corners* corners() const { return corners_.data(); }

private:
    std::vector<uint32_t> first_{0};
    std::vector<Corners> corners_;
};

/// Weights of the corners at the nearest point of the triangle (Ericson, Real-Time Collision
/// Detection, 5.1.5).
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace vfit
