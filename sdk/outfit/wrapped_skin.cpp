#include "outfit/wrapped_skin.h"

#include <algorithm>

#include "body/mesh.h"

namespace vfit {

namespace {

/// Neighbours of all vertices, one list after the other.
struct SkinNeighbours {
    std::vector<uint32_t> first, of;

    SkinNeighbours(size_t count, std::span<const uint32_t> indices) : first(count + 1, 0) {
        // Of a closed mesh each edge leaves each of its ends once.
        for (const uint32_t v : indices) ++first[v + 1];
        for (size_t v = 0; v < count; ++v) first[v + 1] += first[v];
        of.resize(indices.size());
        std::vector<uint32_t> next(first.begin(), first.end() - 1);
        for (size_t i = 0; i + 2 < indices.size(); i += 3)
            for (size_t k = 0; k < 3; ++k) of[next[indices[i + k]]++] = indices[i + (k + 1) % 3];
    }
};

void raise_hollows(std::vector<Vec3>& places, std::span<const uint32_t> indices) {
    constexpr int kRounds = 12;  // reaches as far as a triangle of cloth, some 2 cm
    constexpr float kMost_m =
        0.005f;  // what a side of 2.2 cm spans over a hollow of 12 mm radius; into wider ones cloth hangs
    const std::vector<Vec3> skin = places;
    const SkinNeighbours neighbours(places.size(), indices);
    std::vector<Vec3> normals;
    compute_normals(places, indices, normals);
    for (int round = 0; round < kRounds; ++round)
        for (uint32_t v = 0; v < places.size(); ++v) {
            const uint32_t begin = neighbours.first[v], end = neighbours.first[v + 1];
            if (begin == end) continue;
            Vec3 middle(0.0f);
            for (uint32_t i = begin; i < end; ++i) middle += places[neighbours.of[i]];
            const float hollow = glm::dot(middle / float(end - begin) - places[v], normals[v]);
            const float left = kMost_m - glm::dot(places[v] - skin[v], normals[v]);
            if (hollow > 0.0f) places[v] += normals[v] * std::min(hollow, left);
        }
}

/// What is round goes outwards by what a side of cloth between two vertices on it would lie below it.
void raise_rounds(std::vector<Vec3>& places, std::span<const uint32_t> indices) {
    constexpr float kSide_m = 0.022f, kMost_m = 0.003f;
    const SkinNeighbours neighbours(places.size(), indices);
    std::vector<Vec3> normals;
    compute_normals(places, indices, normals);
    std::vector<float> by(places.size(), 0.0f);
    for (uint32_t v = 0; v < places.size(); ++v) {
        float curvature = 0.0f;  // the greatest along the ways to its neighbours, 1/m
        for (uint32_t i = neighbours.first[v]; i < neighbours.first[v + 1]; ++i) {
            const Vec3 way = places[neighbours.of[i]] - places[v];
            curvature =
                std::max(curvature, -2.0f * glm::dot(way, normals[v]) / std::max(glm::dot(way, way), 1e-8f));
        }
        by[v] = std::min(kMost_m, 0.125f * kSide_m * kSide_m * curvature);
    }
    for (uint32_t v = 0; v < places.size(); ++v) places[v] += normals[v] * by[v];
}

}  // namespace

std::vector<Vec3> wrapped_skin(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    std::vector<Vec3> out(positions.begin(), positions.end());
    raise_hollows(out, indices);
    raise_rounds(out, indices);
    return out;
}

}  // namespace vfit
