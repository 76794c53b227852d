#include "geometry/membrane.h"

#include <algorithm>
#include <utility>

namespace vfit {

Membrane::Membrane(size_t vertices, std::span<const uint32_t> indices) : first_(vertices + 1, 0) {
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = indices[i + k], b = indices[i + (k + 1) % 3];
            pairs.emplace_back(a, b), pairs.emplace_back(b, a);
        }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [a, b] : pairs) ++first_[a + 1], list_.push_back(b);
    for (size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
}

std::vector<Vec3> Membrane::even(std::span<const Vec3> wanted, std::span<const float> weights,
                                 float stiffness, int rounds) const {
    constexpr float kBeyond = 1.7f;  // successive over-relaxation
    std::vector<Vec3> shifts(wanted.begin(), wanted.end());
    for (int round = 0; round < rounds; ++round)
        for (size_t v = 0; v < shifts.size(); ++v) {
            const std::span<const uint32_t> around = neighbours(v);
            if (around.empty()) continue;
            Vec3 sum(0.0f);
            for (const uint32_t n : around) sum += shifts[n];
            const Vec3 best =
                (weights[v] * wanted[v] + stiffness * sum) / (weights[v] + stiffness * float(around.size()));
            shifts[v] += kBeyond * (best - shifts[v]);
        }
    return shifts;
}

}  // namespace vfit
