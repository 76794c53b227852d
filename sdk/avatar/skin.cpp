#include "avatar/skin.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vfit {

namespace {

// Vertices of one item of work: large beside the cost of handing it out, small enough to share evenly.
constexpr uint32_t kChunk = 2048;

struct Share {
    uint16_t bone;
    float weight;
};

}  // namespace

void split_limb_weights(std::span<const Vec3> rest, const std::vector<LimbChain>& limbs,
                        std::span<SkinBones> bones, std::span<SkinWeights> weights) {
    std::vector<Share> shares;
    for (size_t v = 0; v < rest.size(); ++v) {
        shares.clear();
        for (size_t k = 0; k < kSkinBones; ++k)
            if (weights[v][k] > 0.0f) shares.push_back({bones[v][k], weights[v][k]});

        for (const LimbChain& limb : limbs) {
            if (limb.rig_bones.size() < 2) continue;
            float carried = 0.0f;
            for (Share& share : shares)
                if (std::count(limb.rig_bones.begin(), limb.rig_bones.end(), share.bone) > 0) {
                    carried += share.weight;
                    share.weight = 0.0f;
                }
            if (carried == 0.0f) continue;
            const Vec3 axis = limb.far_joint - limb.near_joint;
            const float along = glm::dot(rest[v] - limb.near_joint, axis) / glm::dot(axis, axis);
            const size_t steps = limb.rig_bones.size() - 1;
            const float place = std::clamp(along, 0.0f, 1.0f) * float(steps);
            const size_t step = std::min(static_cast<size_t>(place), steps - 1);
            const float far_share = place - float(step);
            shares.push_back({static_cast<uint16_t>(limb.rig_bones[step]), carried * (1.0f - far_share)});
            shares.push_back({static_cast<uint16_t>(limb.rig_bones[step + 1]), carried * far_share});
        }

        std::sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) {
            return a.weight != b.weight ? a.weight > b.weight : a.bone < b.bone;
        });
        float sum = 0.0f;
        const size_t kept = std::min<size_t>(shares.size(), kSkinBones);
        for (size_t k = 0; k < kept; ++k) sum += shares[k].weight;
        for (size_t k = 0; k < kSkinBones; ++k) {
            const bool used = k < kept && shares[k].weight > 0.0f;
            bones[v][k] = used ? shares[k].bone : uint16_t{0};
            weights[v][k] = used ? shares[k].weight / sum : 0.0f;
        }
    }
}

Skin::Skin(std::span<const SkinBones> bones, std::span<const SkinWeights> weights) {
    first_.reserve(bones.size() + 1);
    influences_.reserve(bones.size() * 3);  // the body's vertices have 2.3 bones on average
    for (size_t v = 0; v < bones.size(); ++v) {
        first_.push_back(static_cast<uint32_t>(influences_.size()));
        for (size_t k = 0; k < kSkinBones; ++k)
            if (weights[v][k] > 0.0f) influences_.push_back({bones[v][k], weights[v][k]});
        if (influences_.size() == first_.back()) fail(VFIT_ERROR_DATA, "no bone carries skin vertex ", v);
    }
    first_.push_back(static_cast<uint32_t>(influences_.size()));
}

void Skin::pose(std::span<const Mat4> matrices, std::span<const Vec3> rest,
                std::span<const Vec3> rest_normals, std::span<Vec3> positions, std::span<Vec3> normals,
                Jobs& jobs) const {
    const uint32_t count = vertex_count();
    parallel_for(jobs, (count + kChunk - 1) / kChunk, [&](uint32_t chunk) {
        const uint32_t end = std::min(count, (chunk + 1) * kChunk);
        for (uint32_t v = chunk * kChunk; v < end; ++v) {
            // Sixteen floats in one plain loop: compilers keep them in four vector registers.
            float m[16] = {};
            for (uint32_t i = first_[v]; i < first_[v + 1]; ++i) {
                const float* bone = &matrices[influences_[i].bone][0][0];
                const float weight = influences_[i].weight;
                for (int k = 0; k < 16; ++k) m[k] += weight * bone[k];
            }
            const Vec3 p = rest[v];
            positions[v] = Vec3(m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12],
                                m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                                m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14]);
            if (normals.empty()) continue;
            const Vec3 n = rest_normals[v];
            const Vec3 turned(m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
                              m[2] * n.x + m[6] * n.y + m[10] * n.z);
            const float squared = glm::dot(turned, turned);
            normals[v] = squared > 1e-12f ? turned / std::sqrt(squared) : n;
        }
    });
}

}  // namespace vfit
