// The two hot loops of the fit, in SIMD: nearest model vertex of a depth point, and products of rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/types.h"

namespace vfit {

/// Points with normals among which the nearest is searched: by squared distance + bend (1 - n.m).
class FitTargets {
public:
    void reserve(uint32_t count);
    void clear() { count_ = 0; }
    /// Overwrites them.
    void wipe();
    void add(const Vec3& place, const Vec3& normal, uint32_t id);
    /// After the last add: fills up the last vector.
    void finish();

    uint32_t count() const { return count_; }
    static constexpr float kBend_m2 = 0.02f;
    static constexpr uint32_t kNone = ~uint32_t(0);

private:
    friend uint32_t nearest_target(const FitTargets& targets, const Vec3& place, const Vec3& normal,
                                   float& score);
    uint32_t count_ = 0;
    std::vector<float> lanes_[7];  // -2 x, y, z; -bend times normal; squared length + bend
    std::vector<uint32_t> ids_;
};

/// The id with the least score, and that score; kNone without targets.
uint32_t nearest_target(const FitTargets& targets, const Vec3& place, const Vec3& normal, float& score);

/// product += rows^T rows, upper triangle (and some of the rest of the blocks on the diagonal). `rows`: count
/// rows of `columns` floats each; `columns` is a multiple of kRowLanes. `product`: columns squared.
inline constexpr size_t kRowLanes = 16;
void add_row_products(const float* rows, size_t count, size_t columns, float* product);

}  // namespace vfit
