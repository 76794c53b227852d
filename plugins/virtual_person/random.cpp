#include "random.h"

#include <cmath>
#include <vector>

namespace vfit::virtual_person {

namespace {

// Newton's method on the normal integral from the last quantile, which lies close by.
std::vector<float> make_quantiles() {
    constexpr int kCount = kQuantileCount;
    constexpr double kSqrtHalf = 0.70710678118654752440, kDensityAtZero = 0.39894228040143267794;
    std::vector<float> table(kCount);
    double x = 0.0;
    for (int i = kCount / 2; i < kCount; ++i) {
        const double upper_tail = 1.0 - (i + 0.5) / kCount;
        for (int step = 0; step < 8; ++step) {
            const double excess = 0.5 * std::erfc(x * kSqrtHalf) - upper_tail;
            x += excess / (kDensityAtZero * std::exp(-0.5 * x * x));
        }
        table[static_cast<size_t>(i)] = static_cast<float>(x);
        table[static_cast<size_t>(kCount - 1 - i)] = static_cast<float>(-x);
    }
    return table;
}

}  // namespace

const float* normal_quantiles() {
    static const std::vector<float> table = make_quantiles();
    return table.data();
}

}  // namespace vfit::virtual_person
