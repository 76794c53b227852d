#include "cloth/garment/held_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vfit {

namespace {

// At 1.05 cloth is stretched less, but its places are further from the skin that they lie on, and more skin
// comes through.
constexpr float kLongest = 1.2f;  // times the length at rest
constexpr int kPasses = 30;

}  // namespace

HeldShape::HeldShape(std::span<const uint32_t> held, std::span<const uint32_t> indices,
                     std::span<const Vec3> rest) {
    std::vector<uint8_t> holds(rest.size());
    for (const uint32_t v : held) holds[v] = 1;
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    for (size_t i = 0; i < indices.size(); ++i) {
        const uint32_t a = indices[i], b = indices[i % 3 == 2 ? i - 2 : i + 1];
        if (holds[a] && holds[b]) pairs.push_back(std::minmax(a, b));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const auto& [a, b] : pairs) edges_.push_back({a, b, kLongest * glm::distance(rest[a], rest[b])});
}

/// Position-based dynamics (Mueller et al. 2007), edge by edge.
void HeldShape::keep_lengths(std::span<Vec3> places) const {
    bool moved = true;
    for (int pass = 0; pass < kPasses && moved; ++pass) {
        moved = false;
        for (const Edge& e : edges_) {
            const Vec3 way = places[e.b] - places[e.a];
            const float square = glm::dot(way, way);
            if (square <= e.longest_m * e.longest_m) continue;
            const Vec3 half = 0.5f * (1.0f - e.longest_m / std::sqrt(square)) * way;
            places[e.a] += half, places[e.b] -= half;
            moved = true;
        }
    }
}

}  // namespace vfit
