#include "outfit/skin_below.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cloth/garment/carried.h"

namespace vfit {

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

SkinBelow skin_below(const DressBody& body, const ContactSkin& skin, std::span<const uint8_t> below,
                     const Creases& creases) {
    Carried carried;
    std::vector<uint32_t> indices, vertices;
    constexpr uint32_t kNone = UINT32_MAX;
    std::vector<uint32_t> place_of(skin.places.size(), kNone);
    for (size_t i = 0; i + 2 < skin.indices.size(); i += 3) {
        const uint32_t* corners = &skin.indices[i];
        if (!std::all_of(corners, corners + 3, [&](uint32_t c) { return below[skin.goes_with[c]] != 0; }))
            continue;
        for (int k = 0; k < 3; ++k) {
            uint32_t& place = place_of[corners[k]];
            if (place == kNone) {
                const uint32_t vertex = skin.goes_with[corners[k]];
                place = uint32_t(vertices.size());
                vertices.push_back(vertex);
                carried.add(skin.places[corners[k]], body.skin_bones[vertex], body.skin_weights[vertex]);
            }
            indices.push_back(place);
        }
    }
    Creases::Mesh creased = creases.mesh_of(vertices, carried.rest);
    return {carried.skin(), std::move(indices), std::move(creased), std::move(vertices)};
}

}  // namespace vfit
