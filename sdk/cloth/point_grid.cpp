#include "cloth/point_grid.h"

#include <bit>

#include "math/finite.h"

namespace vfit {

void PointGrid::reserve(size_t points) {
    mask_ = uint32_t(std::bit_ceil(std::max<size_t>(points, 1) * 2)) - 1;
    first_.assign(size_t(mask_) + 2, 0);
    bucket_of_point_.reserve(points);
    ids_.reserve(points);
    points_.reserve(points);
}

void PointGrid::build(std::span<const Vec3> points, float cell_m) {
    constexpr uint32_t kNone = UINT32_MAX;
    if (points.size() * 2 > size_t(mask_) + 1) reserve(points.size());
    rate_ = 1.0f / cell_m;
    std::fill(first_.begin(), first_.end(), 0);
    bucket_of_point_.resize(points.size());
    uint32_t count = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        bucket_of_point_[i] = finite(points[i]) ? bucket_of(cell_of(points[i])) : kNone;
        if (bucket_of_point_[i] == kNone) continue;
        ++first_[bucket_of_point_[i]];
        ++count;
    }
    uint32_t end = 0;
    for (uint32_t& first : first_) first = end += first;
    ids_.resize(count);
    points_.resize(count);
    for (size_t i = points.size(); i-- > 0;) {
        if (bucket_of_point_[i] == kNone) continue;
        const uint32_t at = --first_[bucket_of_point_[i]];
        ids_[at] = uint32_t(i);
        points_[at].x = points[i];
    }
}

}  // namespace vfit
