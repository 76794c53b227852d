#include "avatar/skin.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.h"

namespace vfit {

namespace {

// Vertices of one item of work: large beside the cost of handing it out, small enough to share evenly.
constexpr uint32_t kChunk = 2048;
constexpr uint32_t kBoneFloats = 16;  // of a bone in the kernels' table

struct Share {
    uint16_t bone;
    float weight;
};

}  // namespace

void split_limb_weights(std::span<const Vec3> rest, std::span<const LimbChain> limbs,
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

Skin::Skin(std::span<const SkinBones> bones, std::span<const SkinWeights> weights, std::span<const Vec3> rest,
           std::span<const Vec3> rest_normals)
    : has_normals_(!rest_normals.empty()) {
    starts_.reserve(bones.size() + 1);
    influences_.reserve(bones.size() * 3);  // the body's vertices have 2.3 bones on average
    rest_.reserve((has_normals_ ? 2 : 1) * bones.size());
    order_.resize(bones.size());
    std::iota(order_.begin(), order_.end(), 0u);
    const auto bone_count = [&](uint32_t v) {
        return std::count_if(weights[v].begin(), weights[v].end(), [](float w) { return w > 0.0f; });
    };
    for (size_t first = 0; first < order_.size(); first += kChunk)
        std::stable_sort(order_.begin() + std::ptrdiff_t(first),
                         order_.begin() + std::ptrdiff_t(std::min(order_.size(), first + kChunk)),
                         [&](uint32_t a, uint32_t b) { return bone_count(a) < bone_count(b); });
    for (uint32_t v : order_) {
        starts_.push_back(static_cast<uint32_t>(influences_.size()));
        for (size_t k = 0; k < kSkinBones; ++k)
            if (weights[v][k] > 0.0f) {
                influences_.push_back({kBoneFloats * bones[v][k], weights[v][k]});
                bone_count_ = std::max(bone_count_, uint32_t(bones[v][k]) + 1);
            }
        if (influences_.size() == starts_.back()) fail(VFIT_ERROR_DATA, "no bone carries skin vertex ", v);
        rest_.push_back(rest[v]);
        if (has_normals_) rest_.push_back(rest_normals[v]);
    }
    starts_.push_back(static_cast<uint32_t>(influences_.size()));
}

size_t Skin::bytes() const {
    return (order_.size() + starts_.size()) * sizeof starts_[0] + influences_.size() * sizeof influences_[0] +
           rest_.size() * sizeof rest_[0];
}

namespace {

void put(float* to, const Vec3& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z, to[3] = 0.0f; }

/// Columns of M, carried into the host's axes.
void put_matrix(const Mat4& m, const Axes& axes, float* to) {
    for (int c = 0; c < 4; ++c) put(to + 4 * c, axes.point_out(Vec3(m[c])));
}

/// The rigid motion M as a unit dual quaternion: rotation q, and half of translation * q.
void put_dual_quaternion(const Mat4& m, float* to) {
    const Quat q = glm::normalize(glm::quat_cast(Mat3(m)));
    const Quat dual = 0.5f * (Quat(0.0f, m[3].x, m[3].y, m[3].z) * q);
    to[0] = q.x, to[1] = q.y, to[2] = q.z, to[3] = q.w;
    to[4] = dual.x, to[5] = dual.y, to[6] = dual.z, to[7] = dual.w;
}

}  // namespace

void Skin::pose(std::span<const Mat4> matrices, SkinMethod method, const Axes& axes, const SkinTarget& target,
                Scratch& scratch, Jobs& jobs) const {
    if (matrices.size() < bone_count_)
        fail(VFIT_ERROR_ARGUMENT, matrices.size(), " skinning matrices for a skin of ", bone_count_,
             " bones");
    if (target.normals && !has_normals_)
        fail(VFIT_ERROR_ARGUMENT, "normals are asked of a skin that has none");
    scratch.resize(kBoneFloats * matrices.size());
    for (size_t b = 0; b < matrices.size(); ++b) {
        float* bone = scratch.data() + kBoneFloats * b;
        if (method == SkinMethod::linear)
            put_matrix(matrices[b], axes, bone);
        else
            put_dual_quaternion(matrices[b], bone);
    }
    float map[12];
    for (int c = 0; c < 3; ++c) {
        Vec3 unit(0.0f);
        unit[c] = 1.0f;
        put(map + 4 * c, axes.point_out(unit));
    }
    const uint32_t count = vertex_count();
    parallel_for(jobs, (count + kChunk - 1) / kChunk, [&](uint32_t chunk) {
        const SkinJob job = {order_.data(),
                             starts_.data(),
                             influences_.data(),
                             scratch.data(),
                             &rest_[0].x,
                             has_normals_ ? 6u : 3u,
                             chunk * kChunk,
                             std::min(count, (chunk + 1) * kChunk),
                             static_cast<unsigned char*>(target.positions),
                             target.position_stride,
                             static_cast<unsigned char*>(target.normals),
                             target.normal_stride};
        if (method == SkinMethod::linear)
            skin_linear(job);
        else
            skin_dual_quaternion(job, map);
    });
}

void Skin::carry(std::span<const Mat4> matrices, std::vector<Vec3>& out, Scratch& scratch, Jobs& jobs) const {
    out.resize(vertex_count());
    SkinTarget target;
    target.positions = out.data();
    pose(matrices, SkinMethod::linear, Axes(), target, scratch, jobs);
}

}  // namespace vfit
