#include "outfit/passing_arms.h"

#include <algorithm>
#include <utility>

#include "outfit/held_cloth.h"

namespace vfit {

PassingArms::PassingArms(ArmFilter filter, std::span<const uint32_t> indices)
    : filter_(std::move(filter)), mask_(filter_.mask) {
    for (const Arm arm : kArms) {
        OfArm& of = of_[size_t(arm)];
        const auto is_of_arm = [&](uint32_t v) { return filter_.category[v] == ArmFilter::category_of(arm); };
        for (uint32_t v = 0; v < filter_.category.size(); ++v)
            if (is_of_arm(v)) of.points.push_back(v);
        for (size_t i = 0; i + 2 < indices.size(); i += 3)
            if (std::all_of(&indices[i], &indices[i] + 3, is_of_arm))
                of.indices.insert(of.indices.end(), &indices[i], &indices[i] + 3);
    }
}

/// Unless it passes.
bool PassingArms::meets(uint32_t vertex, Arm arm) const {
    return (filter_.mask[vertex] & ArmFilter::category_of(arm)) != 0;
}

/// It meets one arm, and other cloth both or none.
bool PassingArms::is_sleeve(uint32_t vertex) const {
    return meets(vertex, Arm::left) != meets(vertex, Arm::right);
}

void PassingArms::meet_again() {
    for (OfArm& of : of_) of.passes = false;
    mask_ = filter_.mask;
}

bool PassingArms::look(const ClothPiece& cloth, const MovingSkin& skin, float dt, Jobs& jobs) {
    bool changes = false;
    for (const Arm arm : kArms) {
        OfArm& of = of_[size_t(arm)];
        of.for_s = of.passes ? of.for_s + dt : 0.0f;
        const bool turns =
            of.passes ? of.for_s >= kPasses_s && skin.share == 1.0f && is_free(cloth, skin.to, arm, jobs)
                      : holds(cloth, skin, arm);
        if (!turns) continue;
        of.passes = !of.passes, of.for_s = 0.0f;
        changes = true;
    }
    if (!changes) return false;
    uint8_t passing = 0;
    for (const Arm arm : kArms)
        if (passes(arm)) passing |= ArmFilter::category_of(arm);
    for (size_t v = 0; v < mask_.size(); ++v)
        mask_[v] = is_sleeve(uint32_t(v)) ? filter_.mask[v] : uint8_t(filter_.mask[v] & ~passing);
    return true;
}

bool PassingArms::holds(const ClothPiece& cloth, const MovingSkin& skin, Arm arm) const {
    const std::vector<uint32_t>& points = of_[size_t(arm)].points;
    return is_held(
        cloth, points.size(), [&](size_t i) { return skin.at(points[i]); },
        [&](uint32_t v) { return meets(v, arm) && !is_sleeve(v); });
}

bool PassingArms::is_free(const ClothPiece& cloth, std::span<const Vec3> skin, Arm arm, Jobs& jobs) {
    OfArm& of = of_[size_t(arm)];
    if (!of.triangles) of.triangles.emplace(skin, of.indices);
    if (!cloth_) cloth_indices_ = cloth.indices(), cloth_.emplace(cloth.positions(), cloth_indices_);
    of.triangles->move(skin, jobs);
    cloth_->move(cloth.positions(), jobs);
    crossed_.clear();
    cloth_->find_crossings(*of.triangles, crossed_, jobs);
    return std::none_of(crossed_.begin(), crossed_.end(), [&](const TrianglePair& pair) {
        const uint32_t* corners = &cloth_indices_[3 * size_t(pair.first)];
        return std::any_of(corners, corners + 3, [&](uint32_t v) { return !is_sleeve(v); });
    });
}

}  // namespace vfit
