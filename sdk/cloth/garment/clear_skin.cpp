#include "cloth/garment/clear_skin.h"

#include <algorithm>
#include <set>

#include "cloth/crossings.h"
#include "core/jobs.h"

namespace vfit {

namespace {

constexpr int kRounds = 40;
constexpr float kStep_m = 0.0005f;

/// The triangles of the skin that come near the cloth as it is moved.
std::vector<uint32_t> near(const SkinSurface& skin, std::span<const uint32_t> triangles,
                           std::span<const Vec3> places) {
    constexpr float kMost_m = float(kRounds) * kStep_m;
    Bounds cloth;
    for (const uint32_t v : triangles) cloth.add(places[v] - kMost_m), cloth.add(places[v] + kMost_m);
    std::vector<uint32_t> out;
    for (size_t i = 0; i + 2 < skin.indices.size(); i += 3) {
        Bounds box;
        for (size_t k = 0; k < 3; ++k) box.add(skin.positions[skin.indices[i + k]]);
        if (box.overlaps(cloth)) out.insert(out.end(), &skin.indices[i], &skin.indices[i] + 3);
    }
    return out;
}

}  // namespace

void clear_skin(const SkinSurface& skin, std::span<const uint32_t> triangles, std::span<Vec3> places) {
    const std::vector<uint32_t> around = near(skin, triangles, places);
    if (around.empty()) return;
    const auto alone = Jobs::own(0);
    TriangleGroups cloth(places, triangles), body(skin.positions, around);
    body.move(skin.positions, *alone);
    std::vector<TrianglePair> crossed;
    for (int round = 0; round < kRounds; ++round) {
        cloth.move(places, *alone);
        crossed.clear();
        cloth.find_crossings(body, crossed, *alone);
        if (crossed.empty()) return;
        std::set<uint32_t> moved;
        for (const TrianglePair& pair : crossed)
            moved.insert(&triangles[3 * pair.first], &triangles[3 * pair.first] + 3);
        for (const uint32_t v : moved) {
            const MeshQuery::Closest closest = skin.query.closest(places[v]);
            const float side = skin.query.inside(places[v]) ? -1.0f : 1.0f;
            const Vec3 outward = closest.distance > 1e-6f
                                     ? (places[v] - closest.point) * (side / closest.distance)
                                     : closest.normal;
            places[v] += outward * kStep_m;
        }
    }
}

}  // namespace vfit
