#include "fit/fit_kernels.h"

#include <algorithm>

#include "core/wipe.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fit/fit_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

size_t Nearest(const float* const* lanes, size_t count, const float* point, float* best_score) {
    const hn::CappedTag<float, kRowLanes> d;
    const size_t n = hn::Lanes(d);
    const auto px = hn::Set(d, point[0]), py = hn::Set(d, point[1]), pz = hn::Set(d, point[2]);
    const auto nx = hn::Set(d, point[3]), ny = hn::Set(d, point[4]), nz = hn::Set(d, point[5]);
    auto best = hn::Set(d, 1e30f), place = hn::Zero(d);
    auto at = hn::Iota(d, 0.0f);  // exact: far fewer than 2^24
    const auto advance = hn::Set(d, float(n));
    for (size_t i = 0; i < count; i += n) {
        auto score = hn::LoadU(d, lanes[6] + i);
        score = hn::MulAdd(px, hn::LoadU(d, lanes[0] + i), score);
        score = hn::MulAdd(py, hn::LoadU(d, lanes[1] + i), score);
        score = hn::MulAdd(pz, hn::LoadU(d, lanes[2] + i), score);
        score = hn::MulAdd(nx, hn::LoadU(d, lanes[3] + i), score);
        score = hn::MulAdd(ny, hn::LoadU(d, lanes[4] + i), score);
        score = hn::MulAdd(nz, hn::LoadU(d, lanes[5] + i), score);
        const auto nearer = hn::Lt(score, best);
        best = hn::IfThenElse(nearer, score, best);
        place = hn::IfThenElse(nearer, at, place);
        at = hn::Add(at, advance);
    }
    alignas(64) float scores[kRowLanes], places[kRowLanes];
    hn::Store(best, d, scores);
    hn::Store(place, d, places);
    size_t lane = 0;
    for (size_t i = 1; i < n; ++i)
        if (scores[i] < scores[lane]) lane = i;
    *best_score = scores[lane];
    return size_t(places[lane]);
}

void RowProducts(const float* rows, size_t count, size_t columns, float* product) {
    const hn::CappedTag<float, kRowLanes> d;
    const size_t n = hn::Lanes(d);
    for (size_t i = 0; i < columns; i += 4)
        for (size_t j = i / n * n; j < columns; j += n) {
            auto a = hn::Zero(d), b = hn::Zero(d), c = hn::Zero(d), e = hn::Zero(d);
            for (const float *row = rows, *end = rows + count * columns; row != end; row += columns) {
                const auto v = hn::LoadU(d, row + j);
                a = hn::MulAdd(hn::Set(d, row[i]), v, a);
                b = hn::MulAdd(hn::Set(d, row[i + 1]), v, b);
                c = hn::MulAdd(hn::Set(d, row[i + 2]), v, c);
                e = hn::MulAdd(hn::Set(d, row[i + 3]), v, e);
            }
            float* out = product + i * columns + j;
            hn::StoreU(hn::Add(hn::LoadU(d, out), a), d, out);
            hn::StoreU(hn::Add(hn::LoadU(d, out + columns), b), d, out + columns);
            hn::StoreU(hn::Add(hn::LoadU(d, out + 2 * columns), c), d, out + 2 * columns);
            hn::StoreU(hn::Add(hn::LoadU(d, out + 3 * columns), e), d, out + 3 * columns);
        }
}

}  // namespace HWY_NAMESPACE
}  // namespace vfit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vfit {

HWY_EXPORT(Nearest);
HWY_EXPORT(RowProducts);

void FitTargets::reserve(uint32_t count) {
    ids_.resize(std::max(ids_.size(), (count / kRowLanes + 1) * kRowLanes));
    for (auto& lane : lanes_) lane.resize(ids_.size());
}

void FitTargets::wipe() {
    for (auto& lane : lanes_) vfit::wipe(std::span(lane));
    vfit::wipe(std::span(ids_));
    count_ = 0;
}

void FitTargets::add(const Vec3& place, const Vec3& normal, uint32_t id) {
    if (count_ >= ids_.size()) reserve(count_ + 256);
    for (int k = 0; k < 3; ++k) {
        lanes_[k][count_] = -2.0f * place[k];
        lanes_[3 + k][count_] = -kBend_m2 * normal[k];
    }
    lanes_[6][count_] = glm::dot(place, place) + kBend_m2;
    ids_[count_++] = id;
}

void FitTargets::finish() {
    const uint32_t count = count_;
    while (count_ % kRowLanes != 0) add(Vec3(1e6f), Vec3(0.0f), kNone);  // never the nearest
    count_ = count;
}

uint32_t nearest_target(const FitTargets& targets, const Vec3& place, const Vec3& normal, float& score) {
    if (targets.count_ == 0) return FitTargets::kNone;
    const float* lanes[7];
    for (size_t k = 0; k < 7; ++k) lanes[k] = targets.lanes_[k].data();
    const float point[6] = {place.x, place.y, place.z, normal.x, normal.y, normal.z};
    const size_t found = HWY_DYNAMIC_DISPATCH(Nearest)(lanes, targets.count_, point, &score);
    score += glm::dot(place, place);
    return targets.ids_[found];
}

void add_row_products(const float* rows, size_t count, size_t columns, float* product) {
    HWY_DYNAMIC_DISPATCH(RowProducts)(rows, count, columns, product);
}

}  // namespace vfit
#endif
