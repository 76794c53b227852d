#include "cloth/skinned_places.h"

#include <algorithm>

#include "core/error.h"

namespace vfit {

bool SkinnedPlaces::add(const Vec3& rest, std::span<const float> bone_weights) {
    std::vector<Influence> list;
    for (size_t bone = 0; bone < bone_weights.size(); ++bone)
        if (bone_weights[bone] > 0.0f) list.push_back({uint16_t(bone), bone_weights[bone]});
    return add(rest, std::move(list));
}

bool SkinnedPlaces::add(const Vec3& rest, const std::array<uint16_t, kSkinBones>& bones,
                        const std::array<float, kSkinBones>& weights) {
    std::vector<Influence> list;
    for (size_t k = 0; k < kSkinBones; ++k)
        if (weights[k] > 0.0f) list.push_back({bones[k], weights[k]});
    return add(rest, std::move(list));
}

bool SkinnedPlaces::add(const Vec3& rest, std::vector<Influence> list) {
    std::stable_sort(list.begin(), list.end(), [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
    if (list.size() > kSkinBones) list.resize(kSkinBones);
    float sum = 0.0f;
    for (const Influence& influence : list) sum += influence.weight;
    if (!(sum > 0.0f)) return false;
    for (Influence& influence : list) {
        influence.weight /= sum;
        bone_count_ = std::max(bone_count_, uint32_t(influence.bone) + 1);
    }
    rest_.push_back(rest);
    influences_.insert(influences_.end(), list.begin(), list.end());
    first_.push_back(uint32_t(influences_.size()));
    return true;
}

void SkinnedPlaces::skin(std::span<const Mat4> matrices, std::vector<Vec3>& out) const {
    if (matrices.size() < bone_count_)
        fail(VFIT_ERROR_ARGUMENT, matrices.size(), " skinning matrices, the garment needs ", bone_count_);
    out.resize(rest_.size());
    for (size_t i = 0; i < rest_.size(); ++i) {
        const Vec4 p(rest_[i], 1.0f);
        Vec3 sum(0.0f);
        for (uint32_t k = first_[i]; k < first_[i + 1]; ++k)
            sum += influences_[k].weight * Vec3(matrices[influences_[k].bone] * p);
        out[i] = sum;
    }
}

}  // namespace vfit
