#include "refit/hidden_below.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "geometry/mesh_query.h"
#include "outfit/hidden_skin.h"

namespace vfit {

namespace {

/// Skin that pokes through: pieces that are seen, with hidden skin around them, and nowhere far from cloth.
void hide_islands(std::span<const Vec3> skin, std::span<const uint32_t> indices, const MeshQuery& cloth,
                  std::vector<uint8_t>& hidden) {
    constexpr float kSmall_m = 0.08f, kPokes_m = 0.02f;
    // Vertices that files have twice, for their uvs, are one.
    std::vector<uint32_t> order(skin.size()), one(skin.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto less = [&](uint32_t a, uint32_t b) {
        return std::tie(skin[a].x, skin[a].y, skin[a].z) < std::tie(skin[b].x, skin[b].y, skin[b].z);
    };
    std::sort(order.begin(), order.end(), less);
    for (size_t i = 0; i < order.size(); ++i)
        one[order[i]] = i > 0 && skin[order[i]] == skin[order[i - 1]] ? one[order[i - 1]] : order[i];
    std::vector<uint8_t> by_hidden(skin.size(), 0);
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        if (hidden[i / 3])
            for (size_t k = 0; k < 3; ++k) by_hidden[one[indices[i + k]]] = 1;
    // Vertices of seen triangles that are connected have one root.
    std::vector<uint32_t> root(skin.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto root_of = [&](uint32_t v) {
        while (root[v] != v) v = root[v] = root[root[v]];
        return v;
    };
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        if (!hidden[i / 3])
            for (size_t k = 1; k < 3; ++k) root[root_of(one[indices[i + k]])] = root_of(one[indices[i]]);
    struct Island {
        Vec3 low{1e9f}, high{-1e9f};
        bool by_hidden = false;
        float off_m = 0.0f;  // the cloth
    };
    std::unordered_map<uint32_t, Island> islands;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        if (hidden[i / 3]) continue;
        Island& island = islands[root_of(one[indices[i]])];
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = one[indices[i + k]];
            island.low = glm::min(island.low, skin[v]), island.high = glm::max(island.high, skin[v]);
            island.by_hidden = island.by_hidden || by_hidden[v];
            island.off_m = std::max(island.off_m, cloth.closest(skin[v]).distance);
        }
    }
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        if (hidden[i / 3]) continue;
        const Island& island = islands[root_of(one[indices[i]])];
        hidden[i / 3] = island.by_hidden &&
                        (glm::distance(island.low, island.high) < kSmall_m || island.off_m < kPokes_m);
    }
}

}  // namespace

std::vector<uint8_t> hidden_below(std::span<const BoundCloth> garments, const Character& character,
                                  const CharacterBody& body, std::span<const uint8_t> left_out,
                                  float margin_m, Jobs& jobs) {
    const std::vector<uint32_t>& indices = character.source.rest.indices;
    std::vector<uint8_t> hidden(left_out.begin(), left_out.end());
    for (const BoundCloth& cloth : garments) {
        const std::vector<uint8_t> below =
            hidden_triangles({body.skin, indices, cloth.positions(), cloth.indices(), true}, margin_m, jobs);
        for (size_t t = 0; t < below.size(); ++t) hidden[t] |= below[t];
    }
    for (const BoundCloth& cloth : garments)
        hide_islands(body.skin, indices, MeshQuery(cloth.positions(), cloth.indices()), hidden);
    return hidden;
}

}  // namespace vfit
