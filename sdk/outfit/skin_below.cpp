#include "outfit/skin_below.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cloth/garment/carried.h"
#include "outfit/mitten.h"

namespace vfit {

namespace {

bool is_hand(const DressBody& body, uint32_t v) {
    return !body.parts.empty() &&
           (body.parts[v] == BodyPart::kLeftHand || body.parts[v] == BodyPart::kRightHand);
}

std::vector<uint32_t> vertices_of(const DressBody& body, std::span<const uint8_t> below, BodyPart part) {
    std::vector<uint32_t> out;
    for (uint32_t v = 0; v < body.parts.size(); ++v)
        if (below[v] && body.parts[v] == part) out.push_back(v);
    return out;
}

Vec3 middle_of(std::span<const Vec3> places, std::span<const uint32_t> vertices) {
    Vec3 sum(0.0f);
    for (const uint32_t v : vertices) sum += places[v];
    return sum / float(std::max<size_t>(vertices.size(), 1));
}

}  // namespace

std::vector<uint8_t> below_garment(const DressBody& body, std::span<const Vec3> garment, ArmsMet arms) {
    constexpr float kAbove_m = 0.1f, kBelow_m = 0.25f;
    float low = INFINITY, high = -INFINITY;
    for (const Vec3& p : garment) low = std::min(low, p.y), high = std::max(high, p.y);
    const auto passes = [&](BodyPart part) {
        if (part == BodyPart::kLeftHand || part == BodyPart::kRightHand) return !arms.hands;
        return (part == BodyPart::kLeftForearm || part == BodyPart::kRightForearm) && !arms.forearms;
    };
    const auto counts = [&](size_t v) {
        const float y = body.positions[v].y;
        const bool level = y > low - kBelow_m && y < high + kAbove_m;
        if (body.parts.empty()) return level;
        const BodyPart part = body.parts[v];
        if (passes(part)) return false;
        return level || is_arm(part);
    };
    std::vector<uint8_t> below(body.positions.size());
    for (size_t v = 0; v < below.size(); ++v) below[v] = counts(v);
    return below;
}

SkinBelow skin_below(const DressBody& body, std::span<const Vec3> wrapped, std::span<const uint8_t> below,
                     const Creases& creases) {
    Carried carried;
    std::vector<uint32_t> indices, vertices;
    const auto add = [&](const Vec3& place, uint32_t vertex) {
        vertices.push_back(vertex);
        carried.add(place, body.skin_bones[vertex], body.skin_weights[vertex]);
    };
    constexpr uint32_t kNone = UINT32_MAX;
    std::vector<uint32_t> place_of(body.positions.size(), kNone);
    for (size_t i = 0; i + 2 < body.indices.size(); i += 3) {
        const uint32_t* v = &body.indices[i];
        if (!below[v[0]] || !below[v[1]] || !below[v[2]]) continue;
        if (is_hand(body, v[0]) && is_hand(body, v[1]) && is_hand(body, v[2])) continue;
        for (int k = 0; k < 3; ++k) {
            if (place_of[v[k]] == kNone) {
                place_of[v[k]] = uint32_t(carried.rest.size());
                add(wrapped[v[k]], v[k]);
            }
            indices.push_back(place_of[v[k]]);
        }
    }
    for (const auto& [forearm, hand] : {std::pair(BodyPart::kLeftForearm, BodyPart::kLeftHand),
                                        std::pair(BodyPart::kRightForearm, BodyPart::kRightHand)}) {
        const std::vector<uint32_t> points = vertices_of(body, below, hand);
        if (points.empty()) continue;
        std::vector<Vec3> places;
        for (const uint32_t v : points) places.push_back(wrapped[v]);
        const Mitten mitten =
            mitten_around(places, glm::normalize(middle_of(wrapped, vertices_of(body, below, forearm)) -
                                                 middle_of(wrapped, points)));
        const auto first = uint32_t(carried.rest.size());
        for (size_t i = 0; i < mitten.places.size(); ++i) add(mitten.places[i], points[mitten.goes_with[i]]);
        for (const uint32_t i : mitten.indices) indices.push_back(first + i);
    }
    Creases::Mesh creased = creases.mesh_of(vertices, carried.rest);
    return {carried.skin(), std::move(indices), std::move(creased), std::move(vertices)};
}

}  // namespace vfit
