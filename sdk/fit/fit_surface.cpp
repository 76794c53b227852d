#include "fit/fit_surface.h"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <set>

namespace vfit {

namespace {

std::vector<uint32_t> farthest_points(std::span<const Vec3> positions, std::span<const float> density,
                                      uint32_t count) {
    std::vector<float> nearest(positions.size(), std::numeric_limits<float>::max());
    std::vector<uint32_t> chosen;
    uint32_t next = 0;
    while (chosen.size() < count) {
        chosen.push_back(next);
        const Vec3 at = positions[next];
        float farthest = -1.0f;
        for (uint32_t v = 0; v < positions.size(); ++v) {
            const Vec3 d = positions[v] - at;
            nearest[v] = std::min(nearest[v], glm::dot(d, d) * density[v] * density[v]);
            if (nearest[v] > farthest) farthest = nearest[v], next = v;
        }
    }
    return chosen;
}

/// The index of the seed nearest to each vertex along edges (Dijkstra 1959, all seeds at once).
std::vector<uint32_t> cells(std::span<const Vec3> positions, std::span<const uint32_t> triangles,
                            const std::vector<uint32_t>& seeds) {
    std::vector<std::vector<uint32_t>> neighbours(positions.size());
    for (size_t t = 0; t + 2 < triangles.size(); t += 3)
        for (size_t k = 0; k < 3; ++k) {
            neighbours[triangles[t + k]].push_back(triangles[t + (k + 1) % 3]);
            neighbours[triangles[t + (k + 1) % 3]].push_back(triangles[t + k]);
        }
    std::vector<float> distance(positions.size(), std::numeric_limits<float>::max());
    std::vector<uint32_t> cell(positions.size(), 0);
    using Entry = std::pair<float, uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (uint32_t i = 0; i < seeds.size(); ++i) {
        distance[seeds[i]] = 0.0f;
        cell[seeds[i]] = i;
        queue.push({0.0f, seeds[i]});
    }
    while (!queue.empty()) {
        const auto [reached, v] = queue.top();
        queue.pop();
        if (reached > distance[v]) continue;
        for (const uint32_t n : neighbours[v]) {
            const float further = reached + glm::distance(positions[v], positions[n]);
            if (further >= distance[n]) continue;
            distance[n] = further;
            cell[n] = cell[v];
            queue.push({further, n});
        }
    }
    return cell;
}

}  // namespace

CoarseSurface coarse_surface(std::span<const Vec3> positions, std::span<const uint32_t> triangles,
                             std::span<const float> density, uint32_t count) {
    CoarseSurface out;
    out.vertices =
        farthest_points(positions, density, std::min(count, static_cast<uint32_t>(positions.size())));
    const std::vector<uint32_t> cell = cells(positions, triangles, out.vertices);
    std::set<std::array<uint32_t, 3>> seen;
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        std::array<uint32_t, 3> corner = {cell[triangles[t]], cell[triangles[t + 1]], cell[triangles[t + 2]]};
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
        std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
        if (seen.insert(corner).second)
            out.triangles.insert(out.triangles.end(), corner.begin(), corner.end());
    }
    return out;
}

}  // namespace vfit
