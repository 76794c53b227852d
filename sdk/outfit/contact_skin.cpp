#include "outfit/contact_skin.h"

#include <algorithm>
#include <utility>

#include "outfit/mitten.h"
#include "outfit/wrapped_skin.h"

namespace vfit {

namespace {

std::vector<uint32_t> vertices_of(const BoundBody& body, BodyPart part) {
    std::vector<uint32_t> out;
    for (uint32_t v = 0; v < body.parts.size(); ++v)
        if (body.parts[v] == part) out.push_back(v);
    return out;
}

Vec3 middle_of(std::span<const Vec3> places, std::span<const uint32_t> vertices) {
    Vec3 sum(0.0f);
    for (const uint32_t v : vertices) sum += places[v];
    return sum / float(std::max<size_t>(vertices.size(), 1));
}

/// All triangles but those of the hands alone.
std::vector<uint32_t> without_hands(const BoundBody& body) {
    const auto is_hand = [&](uint32_t v) {
        return !body.parts.empty() &&
               (body.parts[v] == BodyPart::kLeftHand || body.parts[v] == BodyPart::kRightHand);
    };
    std::vector<uint32_t> out;
    for (size_t i = 0; i + 2 < body.indices.size(); i += 3) {
        const uint32_t* v = &body.indices[i];
        if (!is_hand(v[0]) || !is_hand(v[1]) || !is_hand(v[2])) out.insert(out.end(), v, v + 3);
    }
    return out;
}

}  // namespace

ContactSkin contact_skin(const BoundBody& body) {
    ContactSkin out;
    const std::vector<Vec3> wrapped = wrapped_skin(body.positions, body.indices);
    constexpr uint32_t kNone = UINT32_MAX;
    std::vector<uint32_t> place_of(wrapped.size(), kNone);
    for (const uint32_t v : without_hands(body)) {
        if (place_of[v] == kNone) {
            place_of[v] = uint32_t(out.places.size());
            out.places.push_back(wrapped[v]), out.goes_with.push_back(v);
        }
        out.indices.push_back(place_of[v]);
    }
    for (const auto& [forearm, hand] : {std::pair(BodyPart::kLeftForearm, BodyPart::kLeftHand),
                                        std::pair(BodyPart::kRightForearm, BodyPart::kRightHand)}) {
        const std::vector<uint32_t> points = vertices_of(body, hand);
        if (points.empty()) continue;
        std::vector<Vec3> places;
        for (const uint32_t v : points) places.push_back(wrapped[v]);
        const Mitten mitten = mitten_around(
            places,
            glm::normalize(middle_of(wrapped, vertices_of(body, forearm)) - middle_of(wrapped, points)));
        const auto first = uint32_t(out.places.size());
        out.places.insert(out.places.end(), mitten.places.begin(), mitten.places.end());
        for (const uint32_t i : mitten.goes_with) out.goes_with.push_back(points[i]);
        for (const uint32_t i : mitten.indices) out.indices.push_back(first + i);
    }
    return out;
}

}  // namespace vfit
