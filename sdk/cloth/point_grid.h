// Points in the cells of a grid, sorted by cell: who is near a box (Teschner et al. 2003). Cells share buckets by chance, so
// that some of those named are far.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/particle.h"

namespace vfit {

class PointGrid {
public:
    /// For so many points, build() does not allocate.
    void reserve(size_t points);
    /// Ids: positions in the list. Points that are not finite are left out.
    void build(std::span<const Vec3> points, float cell_m);

    std::span<const Particle> points() const { return points_; }
    std::span<const uint32_t> ids() const { return ids_; }

    /// take(first, last): a range of points() and ids().
    template <typename Take>
    void visit(const Vec3& low, const Vec3& high, const Take& take) const {
        const Cell from = cell_of(low), to = cell_of(high);
        for (int32_t x = from.x; x <= to.x; ++x)
            for (int32_t y = from.y; y <= to.y; ++y)
                for (int32_t z = from.z; z <= to.z; ++z) {
                    const uint32_t bucket = bucket_of({x, y, z});
                    if (first_[bucket] != first_[bucket + 1]) take(first_[bucket], first_[bucket + 1]);
                }
    }

private:
    struct Cell {
        int32_t x, y, z;
    };
    Cell cell_of(const Vec3& p) const {
        // Far off, cells are as one: clothes are metres.
        const Vec3 cell = glm::clamp(glm::floor(p * rate_), Vec3(-1e6f), Vec3(1e6f));
        return {int32_t(cell.x), int32_t(cell.y), int32_t(cell.z)};
    }
    uint32_t bucket_of(const Cell& c) const {
        return (uint32_t(c.x) * 73856093u ^ uint32_t(c.y) * 19349663u ^ uint32_t(c.z) * 83492791u) & mask_;
    }

    float rate_ = 1.0f;  // cells a metre
    uint32_t mask_ = 0;
    std::vector<uint32_t> first_ = {0, 0};  // of each bucket, and the end
    std::vector<uint32_t> bucket_of_point_, ids_;
    Particles points_;
};

}  // namespace vfit
