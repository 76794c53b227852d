// A body as simple as can be, and what it wears.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "cloth/garment/dress.h"

namespace vfit::test {

inline constexpr uint32_t kRound = 32, kLevels = 21;

/// A closed post about the Y axis from 0 to 1 m; bone 0 carries its lower half, bone 1 the upper.
struct Post {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    std::vector<std::array<uint16_t, kSkinBones>> bones;
    std::vector<std::array<float, kSkinBones>> weights;
    std::optional<MeshQuery> skin;

    explicit Post(float radius) {
        for (uint32_t level = 0; level < kLevels; ++level)
            for (uint32_t i = 0; i < kRound; ++i) add(radius, i, float(level) / float(kLevels - 1));
        add(0.0f, 0, 0.0f);
        add(0.0f, 0, 1.0f);
        const uint32_t bottom = kRound * kLevels, top = bottom + 1;
        for (uint32_t i = 0; i < kRound; ++i) {
            const uint32_t next = (i + 1) % kRound;
            indices.insert(indices.end(), {bottom, next, i});
            indices.insert(indices.end(), {top, (kLevels - 1) * kRound + i, (kLevels - 1) * kRound + next});
            for (uint32_t level = 0; level + 1 < kLevels; ++level) {
                const uint32_t a = level * kRound + i, b = level * kRound + next;
                indices.insert(indices.end(), {a, b, a + kRound, b, b + kRound, a + kRound});
            }
        }
        skin.emplace(positions, indices);
    }
    DressBody body() const { return {{positions, indices, bones, weights, {}}, {}, *skin}; }

private:
    void add(float radius, uint32_t i, float y) {
        const float angle = 2.0f * kPi * float(i) / float(kRound);
        positions.emplace_back(radius * std::sin(angle), y, radius * std::cos(angle));
        bones.push_back({});
        bones.back()[0] = y < 0.5f ? 0 : 1;
        weights.push_back({});
        weights.back()[0] = 1.0f;
    }
};

/// A sleeve about the post from 0.3 to 0.7 m; its upper row is skinned, the rest simulated.
inline Garment sleeve(float radius) {
    constexpr uint32_t kRows = 9;
    Garment g;
    g.name = "sleeve";
    g.kind = "dress";
    g.fabric = "cotton";
    for (uint32_t r = 0; r < kRows; ++r)
        for (uint32_t i = 0; i < kRound; ++i) {
            const float angle = 2.0f * kPi * float(i) / float(kRound);
            g.mesh.positions.emplace_back(radius * std::sin(angle), 0.7f - 0.05f * float(r),
                                          radius * std::cos(angle));
            g.mesh.uvs.emplace_back(float(i), float(r));
            g.simulated.push_back(r > 0);
            g.backstop.push_back(1);
        }
    for (uint32_t r = 0; r + 1 < kRows; ++r)
        for (uint32_t i = 0; i < kRound; ++i) {
            const uint32_t a = r * kRound + i, b = r * kRound + (i + 1) % kRound;
            g.mesh.indices.insert(g.mesh.indices.end(), {a, a + kRound, b, b, a + kRound, b + kRound});
        }
    return g;
}

}  // namespace vfit::test
