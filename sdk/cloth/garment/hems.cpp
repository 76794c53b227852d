#include "cloth/garment/hems.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace vfit {

namespace {

bool at_end_of_limb(BodyPart part) {
    return part == BodyPart::kLeftForearm || part == BodyPart::kRightForearm || part == BodyPart::kLeftHand || part == BodyPart::kRightHand ||
           part == BodyPart::kLeftShank || part == BodyPart::kRightShank || part == BodyPart::kLeftFoot || part == BodyPart::kRightFoot;
}

/// Mean length of the ways to the vertices from what is fixed; 0 where there is none.
float mean_way(const std::vector<Tether>& tethers, std::span<const uint32_t> vertices) {
    const std::set<uint32_t> wanted(vertices.begin(), vertices.end());
    float sum = 0.0f;
    int count = 0;
    for (const Tether& t : tethers)
        if (wanted.count(t.vertex)) sum += t.length_m, ++count;
    return count > 0 ? sum / float(count) : 0.0f;
}

}  // namespace

std::vector<std::vector<uint32_t>> limb_hems(std::span<const uint32_t> indices, std::span<const BodyPart> part_below) {
    std::set<std::pair<uint32_t, uint32_t>> sides;
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) sides.insert({indices[i + k], indices[i + (k + 1) % 3]});
    std::map<uint32_t, uint32_t> next;
    for (const auto& [a, b] : sides)
        if (!sides.count({b, a})) next[a] = b;
    std::vector<std::vector<uint32_t>> hems;
    while (!next.empty()) {
        std::vector<uint32_t> line;
        for (auto it = next.begin(); it != next.end();) {
            line.push_back(it->first);
            const uint32_t to = it->second;
            next.erase(it);
            it = next.find(to);
        }
        const auto at_end = std::count_if(line.begin(), line.end(), [&](uint32_t v) { return at_end_of_limb(part_below[v]); });
        if (2 * size_t(at_end) > line.size()) hems.push_back(std::move(line));
    }
    return hems;
}

namespace {

std::vector<DistanceConstraint> sides_of(std::span<const uint32_t> indices, std::span<const Vec3> carried, std::span<const Vec2> cut) {
    std::vector<DistanceConstraint> out;
    for (size_t i = 0; i + 2 < indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const size_t a = i + k, b = i + (k + 1) % 3;
            out.push_back({indices[a], indices[b], cut.empty() ? glm::length(carried[indices[a]] - carried[indices[b]]) : glm::length(cut[a] - cut[b]), 0.0f});
        }
    return out;
}

}  // namespace

void take_up(const std::vector<std::vector<uint32_t>>& hems, std::span<const uint32_t> indices, std::span<const uint8_t> simulated, std::span<const Vec3> carried, std::vector<Vec2>& cut) {
    static const float kSlack_m = getenv("SLACK") ? float(atof(getenv("SLACK"))) : 0.015f;
    constexpr float kReach = 0.7f, kLeast = 0.3f;
    if (hems.empty() || kSlack_m > 1.0f) return;
    std::vector<float> inverse_mass(simulated.begin(), simulated.end());
    const std::vector<DistanceConstraint> own_sides = sides_of(indices, carried, cut);
    const std::vector<Tether> own_ways = cook_tethers(inverse_mass, own_sides), body_ways = cook_tethers(inverse_mass, sides_of(indices, carried, {}));
    for (const std::vector<uint32_t>& hem : hems) {
        const float own = mean_way(own_ways, hem), body = mean_way(body_ways, hem), surplus = own - body - kSlack_m;
        if (getenv("SAYHEM")) fprintf(stderr, "hem of %zu: own %g body %g\n", hem.size(), double(own), double(body));
        if (body == 0.0f || surplus <= 0.0f) continue;
        const float reach = kReach * own, share = std::max(kLeast, 1.0f - surplus / reach);
        std::vector<float> from_hem(simulated.size(), 1.0f);
        for (const uint32_t v : hem) from_hem[v] = 0.0f;
        std::vector<float> way(simulated.size(), INFINITY);
        for (const uint32_t v : hem) way[v] = 0.0f;
        for (const Tether& t : cook_tethers(from_hem, own_sides)) way[t.vertex] = t.length_m;
        for (size_t i = 0; i + 2 < indices.size(); i += 3) {
            const float d[3] = {way[indices[i]], way[indices[i + 1]], way[indices[i + 2]]};
            if (d[0] + d[1] + d[2] > 3.0f * reach) continue;
            const Vec2 p = cut[i + 1] - cut[i], q = cut[i + 2] - cut[i];
            const float det = p.x * q.y - p.y * q.x;
            if (std::abs(det) < 1e-9f) continue;
            Vec2 along((d[1] - d[0]) * q.y - (d[2] - d[0]) * p.y, (d[2] - d[0]) * p.x - (d[1] - d[0]) * q.x);
            if (glm::length(along) < 1e-12f) continue;
            along = glm::normalize(along);
            if (det < 0.0f) along = -along;
            for (size_t k = 1; k < 3; ++k) {
                const Vec2 side = cut[i + k] - cut[i];
                cut[i + k] = cut[i] + side - (1.0f - share) * glm::dot(side, along) * along;
            }
        }
    }
}

void keep_hems(const std::vector<std::vector<uint32_t>>& hems, std::span<const Vec3> carried, FabricData& fabric) {
    constexpr float kLonger = 1.01f, kNear_m = 0.02f;
    if (hems.empty() || getenv("NOLIMIT")) return;
    std::vector<DistanceConstraint> on_body = fabric.edges;
    for (DistanceConstraint& edge : on_body) edge.rest_m = glm::length(carried[edge.a] - carried[edge.b]);
    const std::vector<Tether> ways = cook_tethers(fabric.inverse_mass, on_body);
    for (const std::vector<uint32_t>& hem : hems) {
        const float own = mean_way(fabric.tethers, hem), body = mean_way(ways, hem);
        if (body == 0.0f || own < kLonger * body) continue;
        for (const uint32_t v : hem)
            if (fabric.inverse_mass[v] > 0.0f) fabric.limits.push_back({v, kNear_m});
    }
}

}  // namespace vfit
