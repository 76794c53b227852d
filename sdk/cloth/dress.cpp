#include "cloth/dress.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/error.h"
#include "measure/mesh_query.h"

namespace vfit {

namespace {

bool is_arm(BodyPart part) { return part >= BodyPart::kLeftUpperArm && part <= BodyPart::kRightHand; }

/// The body's triangles that may carry a garment.
std::vector<uint32_t> bindable_triangles(const DressBody& body) {
    if (body.parts.empty()) return {body.indices.begin(), body.indices.end()};
    std::vector<uint32_t> kept;
    for (size_t i = 0; i + 2 < body.indices.size(); i += 3) {
        const uint32_t* v = &body.indices[i];
        if (!is_arm(body.parts[v[0]]) && !is_arm(body.parts[v[1]]) && !is_arm(body.parts[v[2]]))
            kept.insert(kept.end(), v, v + 3);
    }
    return kept;
}

/// A place on the body's surface: three corners and their weights.
struct Binding {
    uint32_t corner[3];
    float weight[3];

    Vec3 on(std::span<const Vec3> body) const {
        return weight[0] * body[corner[0]] + weight[1] * body[corner[1]] + weight[2] * body[corner[2]];
    }
};

void check(const Garment& garment, const DressBody& body) {
    const size_t n = body.authored.size();
    if (n == 0 || body.rest.size() != n)
        fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, ": authored body and avatar differ in topology");
    if (body.skin_bones.size() < n || body.skin_weights.size() < n ||
        (!body.parts.empty() && body.parts.size() < n))
        fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, ": the body's skin has too few vertices");
    for (uint32_t i : body.indices)
        if (i >= n) fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, ": the body's triangles name no such vertex");
}

std::vector<std::vector<uint32_t>> neighbours_of(const Mesh& mesh) {
    std::vector<std::set<uint32_t>> sets(mesh.positions.size());
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            sets[mesh.indices[i + k]].insert(mesh.indices[i + (k + 1) % 3]);
            sets[mesh.indices[i + (k + 1) % 3]].insert(mesh.indices[i + k]);
        }
    std::vector<std::vector<uint32_t>> lists;
    for (const auto& set : sets) lists.emplace_back(set.begin(), set.end());
    return lists;
}

/// Hanging cloth is bound to whichever leg is nearer; between them the carried shape must not tear. Averages
/// each simulated vertex's shift with its neighbours'; the skinned ones keep theirs.
void smooth_shifts(const Garment& garment, std::vector<Vec3>& shifts) {
    constexpr int kRounds = 20;  // reaches about 4 rows of vertices: the width of the gap between the legs
    const std::vector<std::vector<uint32_t>> neighbours = neighbours_of(garment.mesh);
    std::vector<Vec3> next = shifts;
    for (int round = 0; round < kRounds; ++round) {
        for (size_t i = 0; i < shifts.size(); ++i) {
            if (!garment.simulated[i] || neighbours[i].empty()) continue;
            Vec3 sum(0.0f);
            for (uint32_t j : neighbours[i]) sum += shifts[j];
            next[i] = 0.5f * (shifts[i] + sum / float(neighbours[i].size()));
        }
        std::swap(shifts, next);
    }
}

/// Out of the body, to at least that clearance.
void push_out(const MeshQuery& skin, float clearance_m, std::vector<Vec3>& points) {
    for (Vec3& p : points) {
        constexpr int kTries = 4;  // between two thighs, out of one may be into the other
        for (int i = 0; i < kTries; ++i) {
            const float distance = skin.signed_distance(p);
            if (distance >= clearance_m) break;
            const MeshQuery::Closest closest = skin.closest(p);
            const Vec3 outward = closest.distance > 1e-6f ? (p - closest.point) / distance : closest.normal;
            p = closest.point + outward * clearance_m;
        }
    }
}

}  // namespace

Dress::Dress(const Garment& garment, const FabricMaterial& material, const DressBody& body, float size_ratio,
             float thickness_m)
    : indices_(garment.mesh.indices), uvs_(garment.mesh.uvs) {
    check(garment, body);
    const std::vector<uint32_t> triangles = bindable_triangles(body);
    const MeshQuery authored(body.authored, triangles);
    const uint32_t n = garment.vertex_count();
    std::vector<Vec3> shifts(n);
    first_influence_.push_back(0);
    for (uint32_t i = 0; i < n; ++i) {
        const MeshQuery::Closest closest = authored.closest(garment.mesh.positions[i]);
        const uint32_t* v = &triangles[closest.triangle * 3];
        const Binding binding{{v[0], v[1], v[2]},
                              {1.0f - closest.uv.x - closest.uv.y, closest.uv.x, closest.uv.y}};
        // Both bodies stand in the same pose: what lies off the skin is carried as it is, so that ease and
        // flare stay what they were cut to.
        shifts[i] = binding.on(body.rest) - binding.on(body.authored);

        std::map<uint16_t, float> weights;
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < kSkinBones; ++j)
                if (const float w = body.skin_weights[v[k]][size_t(j)] * binding.weight[k]; w > 0.0f)
                    weights[body.skin_bones[v[k]][size_t(j)]] += w;
        std::vector<Influence> list;
        for (const auto& [bone, weight] : weights) list.push_back({bone, weight});
        std::stable_sort(list.begin(), list.end(),
                         [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
        if (list.size() > kSkinBones) list.resize(kSkinBones);
        float sum = 0.0f;
        for (const Influence& influence : list) sum += influence.weight;
        if (!(sum > 0.0f)) fail(VFIT_ERROR_DATA, "garment ", garment.name, ": vertex ", i, " is bound to no bone");
        for (Influence& influence : list) {
            influence.weight /= sum;
            bone_count_ = std::max(bone_count_, uint32_t(influence.bone) + 1);
        }
        influences_.insert(influences_.end(), list.begin(), list.end());
        first_influence_.push_back(uint32_t(influences_.size()));
    }

    smooth_shifts(garment, shifts);
    rest_ = garment.mesh.positions;
    for (uint32_t i = 0; i < n; ++i) rest_[i] += shifts[i];
    const MeshQuery skin(body.rest, body.indices);
    push_out(skin, thickness_m, rest_);

    FabricData data = cook_fabric({rest_, indices_, uvs_, garment.simulated, size_ratio}, material);
    data.backstop_slack_m.assign(n, -1.0f);
    for (uint32_t i = 0; i < n; ++i)
        if (garment.backstop[i] && garment.simulated[i])
            data.backstop_slack_m[i] = std::max(0.0f, skin.signed_distance(rest_[i]) - thickness_m);
    fabric_ = std::make_shared<const Fabric>(std::move(data));
}

void Dress::skin(std::span<const Mat4> matrices, std::vector<Vec3>& targets) const {
    if (matrices.size() < bone_count_)
        fail(VFIT_ERROR_ARGUMENT, matrices.size(), " skinning matrices, the garment needs ", bone_count_);
    targets.resize(rest_.size());
    for (size_t i = 0; i < rest_.size(); ++i) {
        const Vec4 p(rest_[i], 1.0f);
        Vec3 sum(0.0f);
        for (uint32_t k = first_influence_[i]; k < first_influence_[i + 1]; ++k)
            sum += influences_[k].weight * Vec3(matrices[influences_[k].bone] * p);
        targets[i] = sum;
    }
}

}  // namespace vfit
