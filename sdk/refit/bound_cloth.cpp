#include "refit/bound_cloth.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vfit {

namespace {

constexpr size_t kColumns = 3;  // bones of a row, which is evened out as a vector

bool is_used(std::span<const Vec3> row) {
    return std::any_of(row.begin(), row.end(), [](const Vec3& v) { return v != Vec3(0.0f); });
}

}  // namespace

BoundCloth::BoundCloth(const Garment& garment, const BoundGarment& bound, const CharacterBody& body,
                       std::vector<Vec3> positions, std::span<const Stand> stands)
    : garment_(garment),
      stands_(stands),
      membrane_(garment.vertex_count(), garment.mesh.indices),
      parts_(bound.parts_below),
      positions_(std::move(positions)),
      bone_count_(body.from_rest.size()) {
    const size_t n = garment.vertex_count();
    // Close to the skin a vertex goes as that does; where it hangs, with its neighbours over about 10 cm:
    // between legs cloth must not tear.
    constexpr float kCloseToSkin_m = 0.015f, kClose = 20.0f, kHangs = 0.05f, kStiff = 1.0f;
    constexpr int kRounds = 80;
    std::vector<float> own(n);
    for (size_t v = 0; v < n; ++v)
        own[v] =
            kHangs + kClose * std::exp(-glm::distance(garment.mesh.positions[v], bound.skin_below.rest[v]) /
                                       kCloseToSkin_m);
    rows_.assign((bone_count_ + kColumns - 1) / kColumns, std::vector<Vec3>(n, Vec3(0.0f)));
    for (size_t v = 0; v < n; ++v)
        for (size_t j = 0; j < 3; ++j) {
            const uint32_t corner = bound.bindings[v].corner[j];
            for (size_t k = 0; k < size_t(kSkinBones); ++k) {
                const size_t b = body.skin_bones[corner][k];
                rows_[b / kColumns][v][int(b % kColumns)] +=
                    bound.bindings[v].weight[j] * body.skin_weights[corner][k];
            }
        }
    for (std::vector<Vec3>& row : rows_)
        if (is_used(row)) row = membrane_.even(row, own, kStiff, kRounds);
    write_weights();
}

void BoundCloth::write_weights() {
    constexpr size_t kWritten = 4;  // as many as all engines take
    constexpr float kLeast = 0.01f;
    const size_t n = garment_.vertex_count();
    bones_.assign(n, SkinBones{}), weights_.assign(n, SkinWeights{});
    for (size_t v = 0; v < n; ++v) {
        std::vector<std::pair<float, uint16_t>> order;
        for (size_t b = 0; b < bone_count_; ++b)
            if (const float share = rows_[b / kColumns][v][int(b % kColumns)]; share > kLeast)
                order.emplace_back(share, uint16_t(b));
        std::sort(order.rbegin(), order.rend());
        order.resize(std::min(order.size(), kWritten));
        float sum = 0.0f;
        for (const auto& [share, bone] : order) sum += share;
        for (size_t k = 0; k < order.size(); ++k)
            bones_[v][k] = order[k].second, weights_[v][k] = order[k].first / sum;
    }
    to_stand_.clear();
    for (const Stand& stand : stands_) {
        std::vector<Mat4>& list = to_stand_.emplace_back();
        for (size_t v = 0; v < n; ++v)
            list.push_back(blended(bones_[v], weights_[v], stand.matrices) *
                           glm::inverse(blended(bones_[v], weights_[v], stands_[0].matrices)));
    }
}

std::vector<Vec3> BoundCloth::in(size_t stand) const {
    std::vector<Vec3> out;
    for (size_t v = 0; v < positions_.size(); ++v)
        out.push_back(Vec3(to_stand_[stand][v] * Vec4(positions_[v], 1.0f)));
    return out;
}

void BoundCloth::restore(State state) {
    positions_ = std::move(state.positions), rows_ = std::move(state.rows);
    write_weights();
}

void BoundCloth::go_with(std::span<const GoesWith> list) {
    constexpr float kChanges = 0.5f, kStays = 0.1f, kStiff = 1.0f;
    constexpr int kRounds = 20;
    const size_t n = garment_.vertex_count();
    std::vector<std::vector<Vec3>> wanted(rows_.size(), std::vector<Vec3>(n, Vec3(0.0f)));
    std::vector<float> stays(n, kStays), total(n, 0.0f);
    for (const GoesWith& with : list) {
        total[with.vertex] += 1.0f;
        for (size_t k = 0; k < size_t(kSkinBones); ++k) {
            const size_t b = (*with.bones)[k];
            wanted[b / kColumns][with.vertex][int(b % kColumns)] += (*with.weights)[k];
        }
    }
    // The change is evened out, not the weights: what does not go along stays as it is.
    for (size_t r = 0; r < rows_.size(); ++r) {
        if (!is_used(rows_[r]) && !is_used(wanted[r])) continue;
        std::vector<Vec3> change(n, Vec3(0.0f));
        for (size_t v = 0; v < n; ++v)
            if (total[v] > 0.0f) {
                change[v] = kChanges * (wanted[r][v] / total[v] - rows_[r][v]);
                stays[v] = 1.0f;
            }
        const std::vector<Vec3> evened = membrane_.even(change, stays, kStiff, kRounds);
        for (size_t v = 0; v < n; ++v) rows_[r][v] = glm::max(rows_[r][v] + evened[v], Vec3(0.0f));
    }
    write_weights();
}

}  // namespace vfit
