#include "cloth/garment/carry.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_inverse.hpp>

#include "core/error.h"

namespace vfit {

namespace {

constexpr uint32_t kCarryChunk = 1024;  // vertices of one item of work

/// Of the volume that a rigid motion keeps. A blend of bones that are turned far against each other is flat,
/// and its inverse would throw vertices far away: these go with one bone.
constexpr float kFlattest = 0.2f;

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
    const float length2 = glm::dot(v, v);
    return length2 > 1e-12f ? v / std::sqrt(length2) : otherwise;
}

}  // namespace

Carry::Carry(std::span<const SkinBones> bones, std::span<const SkinWeights> weights) {
    starts_.reserve(bones.size() + 1);
    for (size_t v = 0; v < bones.size(); ++v) {
        starts_.push_back(static_cast<uint32_t>(influences_.size()));
        for (size_t k = 0; k < kSkinBones; ++k) {
            if (weights[v][k] <= 0.0f) continue;
            influences_.push_back({bones[v][k], weights[v][k]});
            bone_count_ = std::max(bone_count_, uint32_t(bones[v][k]) + 1);
        }
    }
    starts_.push_back(static_cast<uint32_t>(influences_.size()));
}

uint32_t Carry::heaviest_bone(uint32_t vertex) const {
    const std::span<const Influence> all = of_vertex(vertex);
    return std::max_element(all.begin(), all.end(),
                            [](const Influence& a, const Influence& b) { return a.weight < b.weight; })
        ->bone;
}

Mat4 Carry::blended(uint32_t vertex, std::span<const Mat4> matrices) const {
    Mat4 out(0.0f);
    for (const Influence& by : of_vertex(vertex)) out += by.weight * matrices[by.bone];
    return out;
}

Mat4 Carry::motion(uint32_t vertex, std::span<const Mat4> from, std::span<const Mat4> to) const {
    const Mat4 before = blended(vertex, from);
    if (glm::determinant(Mat3(before)) < kFlattest)
        return to[heaviest_bone(vertex)] * glm::affineInverse(from[heaviest_bone(vertex)]);
    return blended(vertex, to) * glm::affineInverse(before);
}

void Carry::check_matrices(std::span<const Mat4> matrices) const {
    if (matrices.size() < bone_count_)
        fail(VFIT_ERROR_ARGUMENT, matrices.size(), " skinning matrices for cloth on ", bone_count_, " bones");
}

/// Calls vertex(i, blended matrix) for all.
template <typename Vertex>
void Carry::for_all(std::span<const Mat4> matrices, Jobs& jobs, const Vertex& vertex) const {
    check_matrices(matrices);
    const uint32_t count = vertex_count();
    parallel_for(jobs, (count + kCarryChunk - 1) / kCarryChunk, [&](uint32_t chunk) {
        const uint32_t last = std::min(count, (chunk + 1) * kCarryChunk);
        for (uint32_t i = chunk * kCarryChunk; i < last; ++i) vertex(i, blended(i, matrices));
    });
}

void Carry::take_out(std::span<const Mat4> matrices, std::span<const Vec3> positions,
                     std::span<const Vec3> normals, Unposed& out, Jobs& jobs) const {
    out.positions.resize(vertex_count());
    out.normals.resize(vertex_count());
    out.by_heaviest.resize(vertex_count());
    for_all(matrices, jobs, [&](uint32_t i, const Mat4& blended) {
        const bool flat = glm::determinant(Mat3(blended)) < kFlattest;
        const Mat4& m = flat ? matrices[heaviest_bone(i)] : blended;
        const Mat3 back = glm::inverse(Mat3(m));
        out.by_heaviest[i] = flat;
        out.positions[i] = back * (positions[i] - Vec3(m[3]));
        out.normals[i] = back * normals[i];
    });
}

std::vector<Vec3> Carry::on_axes(std::span<const BoneAxis> axes, std::span<const Vec3> positions) const {
    std::vector<Vec3> out;
    for (uint32_t i = 0; i < vertex_count(); ++i) {
        Vec3& on = out.emplace_back(0.0f);
        for (uint32_t k = starts_[i]; k < starts_[i + 1]; ++k)
            on += influences_[k].weight * axes[influences_[k].bone].nearest(positions[i]);
    }
    return out;
}

void Carry::put_in(std::span<const Mat4> matrices, const Unposed& cloth, std::span<Vec3> positions,
                   std::span<Vec3> normals, Jobs& jobs) const {
    for_all(matrices, jobs, [&](uint32_t i, const Mat4& blended) {
        const Mat4& m = cloth.by_heaviest[i] ? matrices[heaviest_bone(i)] : blended;
        const Mat3 linear(m);
        positions[i] = linear * cloth.positions[i] + Vec3(m[3]);
        normals[i] = unit_or(linear * cloth.normals[i], Vec3(0.0f, 1.0f, 0.0f));
    });
}

}  // namespace vfit
