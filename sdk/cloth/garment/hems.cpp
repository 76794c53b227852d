#include "cloth/garment/hems.h"

#include <algorithm>
#include <cmath>

#include "cloth/garment/borders.h"

namespace vfit {

namespace {

constexpr float kFolds_m =
    0.015f;  // that sleeves and legs may be too long by: what lies in folds above the hem

bool at_end_of_arm(BodyPart part) {
    return part == BodyPart::kLeftForearm || part == BodyPart::kRightForearm || part == BodyPart::kLeftHand ||
           part == BodyPart::kRightHand;
}
bool at_end_of_leg(BodyPart part) {
    return part == BodyPart::kLeftShank || part == BodyPart::kRightShank || part == BodyPart::kLeftFoot ||
           part == BodyPart::kRightFoot;
}

/// One a side of each triangle, of that length.
template <typename Length>
std::vector<DistanceConstraint> sides_of(std::span<const uint32_t> indices, Length&& length) {
    std::vector<DistanceConstraint> out;
    out.reserve(indices.size());
    for (uint32_t i = 0; i < indices.size() / 3 * 3; ++i)
        out.push_back({indices[i], indices[next_corner(i)], length(i), 0.0f});
    return out;
}

/// Along the cloth from the nearest place that is fixed (inverse_mass 0), one a vertex; infinite: no way
/// leads there.
std::vector<float> ways_from(std::span<const float> inverse_mass,
                             const std::vector<DistanceConstraint>& sides) {
    std::vector<float> ways;
    for (const float inverse : inverse_mass) ways.push_back(inverse > 0.0f ? INFINITY : 0.0f);
    for (const Tether& t : cook_tethers(inverse_mass, sides)) ways[t.vertex] = t.length_m;
    return ways;
}

/// Over the vertices that a way leads to; 0: there is none.
float mean_way(const std::vector<float>& ways, std::span<const uint32_t> vertices) {
    float sum = 0.0f;
    int count = 0;
    for (const uint32_t v : vertices)
        if (ways[v] > 0.0f && ways[v] < INFINITY) sum += ways[v], ++count;
    return count > 0 ? sum / float(count) : 0.0f;
}

struct Mean {
    Vec3 sum{0.0f};
    float count = 0.0f;

    void add(const Vec3& p) { sum += p, count += 1.0f; }
    Vec3 of() const { return sum / std::max(count, 1.0f); }
};

/// Of each vertex of a hem, the nearest vertex of those that lie a palm's breadth away from the hem along the
/// cloth. Itself, where the sleeve or leg is shorter than that.
std::vector<LimbHem::UpTheLimb> up_the_limb(std::span<const uint32_t> hem, std::span<const Vec3> carried,
                                            const std::vector<DistanceConstraint>& sides) {
    constexpr float kUp_m = 0.09f, kWide_m = 0.03f;
    std::vector<float> is_not_hem(carried.size(), 1.0f);
    for (const uint32_t v : hem) is_not_hem[v] = 0.0f;
    const std::vector<float> ways = ways_from(is_not_hem, sides);
    std::vector<uint32_t> band;
    for (uint32_t v = 0; v < carried.size(); ++v)
        if (ways[v] >= kUp_m && ways[v] <= kUp_m + kWide_m) band.push_back(v);
    std::vector<LimbHem::UpTheLimb> out;
    for (const uint32_t v : hem) {
        LimbHem::UpTheLimb up{v, band.empty() ? 0.0f : INFINITY};
        for (const uint32_t other : band)
            if (const float away_m = glm::distance(carried[v], carried[other]); away_m < up.distance_m)
                up = {other, away_m};
        out.push_back(up);
    }
    return out;
}

/// Of a triangle laid flat, the direction in which a value at its corners grows; zero: it is the same at all.
Vec2 growth(const Vec2* corner, const float (&value)[3]) {
    const Vec2 p = corner[1] - corner[0], q = corner[2] - corner[0];
    const float a = value[1] - value[0], b = value[2] - value[0];
    const Vec2 way =
        Vec2(a * q.y - b * p.y, b * p.x - a * q.x) * (p.x * q.y - p.y * q.x < 0.0f ? -1.0f : 1.0f);
    const float length = glm::length(way);
    return length > 1e-12f ? way / length : Vec2(0.0f);
}

}  // namespace

std::vector<LimbHem> limb_hems(std::span<const uint32_t> indices, std::span<const BodyPart> part_below,
                               std::span<const uint8_t> simulated, std::span<const Vec3> carried) {
    std::vector<LimbHem> hems;
    for (const std::vector<uint32_t>& line : border_lines(indices)) {
        size_t arm = 0, leg = 0;
        for (const uint32_t corner : line)
            arm += at_end_of_arm(part_below[indices[corner]]),
                leg += at_end_of_leg(part_below[indices[corner]]);
        if (2 * (arm + leg) <= line.size()) continue;
        LimbHem& hem = hems.emplace_back();
        hem.of_arm = arm > leg;
        for (const uint32_t corner : line) hem.vertices.push_back(indices[corner]);
    }
    if (hems.empty()) return hems;
    const std::vector<float> inverse_mass(simulated.begin(), simulated.end());
    const auto sides = sides_of(indices, [&](uint32_t i) {
        return glm::length(carried[indices[i]] - carried[indices[next_corner(i)]]);
    });
    const auto ways = ways_from(inverse_mass, sides);
    for (LimbHem& hem : hems) {
        hem.way_m = mean_way(ways, hem.vertices);
        hem.up = up_the_limb(hem.vertices, carried, sides);
    }
    return hems;
}

void end_at_wrists(std::span<LimbHem> hems, const BoundBody& body, std::span<const Vec3> carried) {
    if (body.parts.empty()) return;
    for (const auto& [forearm, hand] : {std::pair(BodyPart::kLeftForearm, BodyPart::kLeftHand),
                                        std::pair(BodyPart::kRightForearm, BodyPart::kRightHand)}) {
        Mean arm, wrist;
        for (size_t v = 0; v < body.positions.size(); ++v)
            if (body.parts[v] == forearm) arm.add(body.positions[v]);
        for (size_t i = 0; i + 2 < body.indices.size(); i += 3) {
            const uint32_t* t = &body.indices[i];
            const auto is_of = [&](BodyPart part) {
                return std::any_of(t, t + 3, [&](uint32_t v) { return body.parts[v] == part; });
            };
            if (is_of(forearm) && is_of(hand))
                for (size_t k = 0; k < 3; ++k) wrist.add(body.positions[t[k]]);
        }
        if (arm.count == 0.0f || wrist.count == 0.0f) continue;
        const Vec3 along = glm::normalize(wrist.of() - arm.of());
        for (LimbHem& hem : hems) {
            Mean middle;
            for (const uint32_t v : hem.vertices) middle.add(carried[v]);
            const bool is_its = hem.of_arm && middle.of().x * wrist.of().x > 0.0f;
            const float past_m = glm::dot(middle.of() - wrist.of(), along);
            if (!is_its || hem.way_m == 0.0f || past_m <= 0.0f) continue;
            hem.past_wrist_m = past_m;
            hem.way_m -= past_m + kFolds_m;
        }
    }
}

TakenUp take_up(std::span<const LimbHem> hems, std::span<const uint32_t> indices,
                std::span<const uint8_t> simulated, std::vector<Vec2>& cut) {
    // So much of the way to the hem is of the limb: less than from the crotch or the armhole.
    constexpr float kOfLimb = 0.7f, kShortest = 0.3f;
    TakenUp taken;
    if (hems.empty()) return taken;
    const auto sides =
        sides_of(indices, [&](uint32_t i) { return glm::length(cut[i] - cut[next_corner(i)]); });
    const std::vector<float> ways = ways_from(std::vector<float>(simulated.begin(), simulated.end()), sides);
    for (const LimbHem& hem : hems) {
        const float own = mean_way(ways, hem.vertices), reach = kOfLimb * own,
                    surplus = std::min(own - hem.way_m - kFolds_m, (1.0f - kShortest) * reach);
        if (hem.way_m == 0.0f || surplus <= 0.0f) continue;
        float& most = hem.of_arm ? taken.sleeves_m : taken.legs_m;
        most = std::max(most, surplus);
        std::vector<float> is_not_hem(simulated.size(), 1.0f);
        for (const uint32_t v : hem.vertices) is_not_hem[v] = 0.0f;
        const std::vector<float> from_hem = ways_from(is_not_hem, sides);
        for (size_t i = 0; i + 2 < indices.size(); i += 3) {
            const float way[3] = {from_hem[indices[i]], from_hem[indices[i + 1]], from_hem[indices[i + 2]]};
            if (!(way[0] + way[1] + way[2] < 3.0f * reach)) continue;
            const Vec2 along = growth(&cut[i], way);
            for (size_t k = 1; k < 3; ++k)
                cut[i + k] -= (surplus / reach) * glm::dot(cut[i + k] - cut[i], along) * along;
        }
    }
    return taken;
}

void keep_hems(std::span<const LimbHem> hems, std::span<const Tether> tethers, FabricData& fabric) {
    constexpr float kLonger = 1.01f, kFurther_m = 0.02f;
    std::vector<float> ways(fabric.inverse_mass.size(), INFINITY);
    for (const Tether& t : tethers) ways[t.vertex] = t.length_m;
    for (const LimbHem& hem : hems) {
        if (hem.way_m == 0.0f || mean_way(ways, hem.vertices) < kLonger * hem.way_m) continue;
        for (size_t i = 0; i < hem.vertices.size(); ++i)
            if (const uint32_t v = hem.vertices[i]; fabric.inverse_mass[v] > 0.0f)
                fabric.limits.push_back(
                    {v, hem.up[i].distance_m + kFurther_m + hem.past_wrist_m, hem.up[i].vertex});
    }
}

}  // namespace vfit
