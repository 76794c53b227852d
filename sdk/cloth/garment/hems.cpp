#include "cloth/garment/hems.h"

#include <algorithm>
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

void keep_hems(const std::vector<std::vector<uint32_t>>& hems, std::span<const Vec3> carried, FabricData& fabric) {
    constexpr float kLonger = 1.01f, kNear_m = 0.02f;
    if (hems.empty()) return;
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
