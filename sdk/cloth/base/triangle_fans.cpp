#include "cloth/base/triangle_fans.h"

namespace vfit {

TriangleFans::TriangleFans(size_t points, std::span<const uint32_t> indices)
    : first_(points + 1, 0), corners_(indices.size()) {
    for (uint32_t v : indices) ++first_[v + 1];
    for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<uint32_t> fill(first_.begin(), first_.end() - 1);
    for (size_t i = 0; i < indices.size(); ++i) {
        const size_t t = i / 3 * 3, k = i - t;
        corners_[fill[indices[i]]++] = {indices[t + (k + 1) % 3], indices[t + (k + 2) % 3]};
    }
}

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0f && d2 <= 0.0f) return {1, 0, 0};
    const float d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0f && d4 <= d3) return {0, 1, 0};
    const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0f && d5 <= d6) return {0, 0, 1};
    const float beside_ab = d1 * d4 - d3 * d2, beside_ac = d5 * d2 - d1 * d6, beside_bc = d3 * d6 - d5 * d4;
    if (beside_ab <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) {
        const float t = d1 > d3 ? d1 / (d1 - d3) : 0.0f;
        return {1.0f - t, t, 0};
    }
    if (beside_ac <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) {
        const float t = d2 > d6 ? d2 / (d2 - d6) : 0.0f;
        return {1.0f - t, 0, t};
    }
    if (beside_bc <= 0.0f && d4 >= d3 && d5 >= d6) {
        const float whole = (d4 - d3) + (d5 - d6), t = whole > 0.0f ? (d4 - d3) / whole : 0.0f;
        return {0, 1.0f - t, t};
    }
    const float sum = beside_ab + beside_ac + beside_bc;
    return sum > 0.0f ? Vec3(beside_bc, beside_ac, beside_ab) / sum : Vec3(1, 0, 0);
}

}  // namespace vfit
