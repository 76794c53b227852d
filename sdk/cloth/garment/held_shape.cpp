#include "cloth/garment/held_shape.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace vfit {

namespace {

constexpr float kLongest = 1.1f;  // times the length at rest
constexpr int kPasses = 8;        // with 30, a step of the sundress takes a quarter longer

}  // namespace

HeldShape::HeldShape(std::span<const uint32_t> held, std::span<const uint32_t> indices,
                     std::span<const Vec3> rest) {
    std::vector<uint8_t> holds(rest.size());
    for (const uint32_t v : held) holds[v] = 1;
    std::map<std::pair<uint32_t, uint32_t>, int> triangles_at;  // an edge
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const uint32_t* v = &indices[i];
        if (!holds[v[0]] || !holds[v[1]] || !holds[v[2]]) continue;
        for (size_t k = 0; k < 3; ++k) ++triangles_at[std::minmax(v[k], v[(k + 1) % 3])];
    }
    enum : uint8_t { outside, inside, border };
    std::vector<uint8_t> lies(rest.size(), outside);
    for (const auto& [edge, triangles] : triangles_at)
        for (const uint32_t v : {edge.first, edge.second})
            lies[v] = std::max(lies[v], uint8_t(triangles == 1 ? border : inside));
    const auto is_inside = [&](uint32_t v) { return lies[v] == inside; };
    if (2 * std::count_if(held.begin(), held.end(), is_inside) < std::ptrdiff_t(held.size()))
        return;  // a band
    for (const auto& [edge, triangles] : triangles_at)
        edges_.push_back(
            {edge.first, edge.second, kLongest * glm::distance(rest[edge.first], rest[edge.second])});
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
