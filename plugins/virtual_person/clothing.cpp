#include "clothing.h"

#include <array>
#include <cmath>
#include <map>

#include "smooth_field.h"
#include "steps.h"

namespace vfit::virtual_person {

namespace {

// Garments hang in folds of about a hand's breadth to a foot's length, with fine wrinkles between them. The
// shares are rough: the thickness of a loose garment goes from touching the skin to twice its mean.
constexpr float kFold_m = 0.30f, kWrinkle_m = 0.08f, kFoldShare = 0.7f, kWrinkleShare = 0.3f;
constexpr float kHem_m = 0.04f;      // over which a garment ends
constexpr float kLooseness = 0.35f;  // how much top and trousers may differ from their mean

/// 0 outside, 1 inside, over a hem's width about the border.
float inside(float beyond_border_m) { return ease(beyond_border_m / kHem_m + 0.5f); }

/// What each vertex stands for: a third of its triangles' area.
std::vector<float> areas_of(std::span<const float> rest, std::span<const uint32_t> triangles) {
    std::vector<float> areas(rest.size() / 3, 0.0f);
    const auto at = [&](uint32_t v) { return Vec3(rest[3 * v], rest[3 * v + 1], rest[3 * v + 2]); };
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const Vec3 a = at(triangles[i]), b = at(triangles[i + 1]), c = at(triangles[i + 2]);
        const float third = glm::length(glm::cross(b - a, c - a)) / 6.0f;
        for (size_t k = 0; k < 3; ++k) areas[triangles[i + k]] += third;
    }
    return areas;
}

std::vector<uint32_t> first_at_same_place(std::span<const float> rest) {
    std::map<std::array<float, 3>, uint32_t> places;
    std::vector<uint32_t> first(rest.size() / 3);
    for (uint32_t v = 0; v < first.size(); ++v)
        first[v] = places.try_emplace({rest[3 * v], rest[3 * v + 1], rest[3 * v + 2]}, v).first->second;
    return first;
}

}  // namespace

Clothing::Clothing(std::span<const float> rest, std::span<const uint32_t> triangles, const BodyLandmarks& l,
                   const Thickness& thickness, uint64_t seed)
    : offsets_m_(rest.size() / 3), surface_(rest.size()), same_place_(first_at_same_place(rest)) {
    const uint64_t key = random_bits(0x636C6F746865ull, seed);
    const float looser = kLooseness * (2.0f * uniform(key, 0) - 1.0f);
    const std::vector<float> areas = areas_of(rest, triangles);
    double covered = 0.0, moved = 0.0;
    for (size_t v = 0; v < offsets_m_.size(); ++v) {
        const Vec3 p(rest[3 * v], rest[3 * v + 1], rest[3 * v + 2]);
        const bool arm = std::abs(p.x) > l.shoulder_x;
        const bool top = arm || p.y > l.waist_y;
        const float cover = arm   ? inside(l.wrist_x - std::abs(p.x) - kHem_m / 2)
                            : top ? inside(l.neck_y - p.y)
                                  : inside(p.y - l.ankle_y - kHem_m / 2);
        if (cover <= 0.0f) continue;
        const uint64_t garment = random_bits(key, top ? 1 : 2);
        const float uneven = 1.0f + kFoldShare * smooth_field(garment, p / kFold_m) +
                             kWrinkleShare * smooth_field(garment + 1, p / kWrinkle_m);
        if (thickness.by_zone()) {
            const float sleeve = inside(std::abs(p.x) - l.shoulder_x);
            const float on_top = glm::mix(thickness.top(), thickness.sleeves(), sleeve);
            offsets_m_[v] = cover * uneven * (top ? on_top : thickness.trousers());
            continue;
        }
        offsets_m_[v] = cover * uneven * (top ? 1.0f + looser : 1.0f - looser);
        covered += double(areas[v] * cover);
        moved += double(areas[v] * offsets_m_[v]);
    }
    if (thickness.by_zone()) return;
    const auto scale = static_cast<float>(moved > 0.0 ? double(thickness.mean_m) * covered / moved : 0.0);
    for (float& offset : offsets_m_) offset *= scale;
}

const float* Clothing::dress(const float* skin, const float* normals) {
    // One normal for all vertices of a place: the cloth must not tear there.
    for (size_t v = 0; v < offsets_m_.size(); ++v)
        for (size_t k = 0; k < 3; ++k)
            surface_[3 * v + k] = skin[3 * v + k] + offsets_m_[v] * normals[3 * same_place_[v] + k];
    return surface_.data();
}

}  // namespace vfit::virtual_person
