#include "cloth/garment/carried.h"

#include <algorithm>
#include <numeric>

namespace vfit {

void Carried::add(const Vec3& place, std::span<const float> bone_weights) {
    constexpr float kTail = 0.01f;
    const float least = kTail * std::accumulate(bone_weights.begin(), bone_weights.end(), 0.0f);
    std::vector<size_t> order;
    for (size_t bone = 0; bone < bone_weights.size(); ++bone)
        if (bone_weights[bone] > least) order.push_back(bone);
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return bone_weights[a] > bone_weights[b]; });
    order.resize(std::min<size_t>(order.size(), kSkinBones));
    float sum = 0.0f;
    for (size_t bone : order) sum += bone_weights[bone];
    SkinBones by{};
    SkinWeights shares{};
    for (size_t k = 0; k < order.size(); ++k)
        by[k] = uint16_t(order[k]), shares[k] = bone_weights[order[k]] / sum;
    add(place, by, shares);
}

}  // namespace vfit
