#include "body/piece_of_surface.h"

#include <unordered_map>

namespace vfit {

std::vector<uint32_t> triangles_of(const BodyTopology& topology, BodyPart part) {
    std::vector<uint32_t> out;
    for (size_t t = 0; t + 2 < topology.indices.size(); t += 3) {
        bool all = true;
        for (size_t k = 0; k < 3; ++k) all = all && topology.parts[topology.indices[t + k]] == part;
        if (all)
            out.insert(out.end(), topology.indices.begin() + std::ptrdiff_t(t),
                       topology.indices.begin() + std::ptrdiff_t(t) + 3);
    }
    return out;
}

double enclosed_volume(const std::vector<Vec3>& positions, const std::vector<uint32_t>& triangles) {
    const auto six_volumes = [](const Vec3& a, const Vec3& b, const Vec3& c) {
        return double(glm::dot(a, glm::cross(b, c)));
    };
    double sum = 0.0;
    std::unordered_map<uint64_t, bool> edges;
    const auto key = [](uint32_t a, uint32_t b) { return (uint64_t(a) << 32) | b; };
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        sum += six_volumes(positions[triangles[t]], positions[triangles[t + 1]], positions[triangles[t + 2]]);
        for (size_t k = 0; k < 3; ++k) edges[key(triangles[t + k], triangles[t + (k + 1) % 3])] = true;
    }
    std::unordered_map<uint32_t, uint32_t> next;  // along the borders
    for (const auto& [edge, used] : edges) {
        const auto a = uint32_t(edge >> 32), b = uint32_t(edge);
        if (used && !edges.count(key(b, a))) next[b] = a;
    }
    while (!next.empty()) {
        std::vector<uint32_t> loop;
        uint32_t at = next.begin()->first;
        for (auto it = next.find(at); it != next.end(); it = next.find(at)) {
            loop.push_back(at);
            at = it->second;
            next.erase(it);
        }
        Vec3 middle(0.0f);
        for (const uint32_t v : loop) middle += positions[v] / float(loop.size());
        for (size_t i = 0; i < loop.size(); ++i)
            sum += six_volumes(positions[loop[i]], positions[loop[(i + 1) % loop.size()]], middle);
    }
    return sum / 6.0;
}

}  // namespace vfit
