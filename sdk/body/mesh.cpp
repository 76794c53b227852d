#include "body/mesh.h"

#include <cmath>

namespace vfit {

void compute_normals(std::span<const Vec3> positions, std::span<const uint32_t> indices,
                     std::vector<Vec3>& normals) {
    normals.assign(positions.size(), Vec3(0.0f));
    for (size_t t = 0; t + 2 < indices.size(); t += 3) {
        const uint32_t a = indices[t], b = indices[t + 1], c = indices[t + 2];
        // The cross product's length is twice the area: the sum is area-weighted by itself.
        const Vec3 n = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
        normals[a] += n;
        normals[b] += n;
        normals[c] += n;
    }
    for (Vec3& n : normals) {
        const float length2 = glm::dot(n, n);
        n = length2 > 1e-24f ? n * (1.0f / std::sqrt(length2)) : Vec3(0, 1, 0);
    }
}

}  // namespace vfit
