#include "size/measure_steps.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace vfit {

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
// Standard deviation of a measure, as a fraction of its mean, among people of the same chest or waist girth:
// 0.03 to 0.07 for every length and girth of clothing in ANSUR II (stature 0.04, inside leg 0.055, hips
// 0.045).
constexpr double kSpread = 0.05;

bool below(const MeasureRange& a, const MeasureRange& b) {
    return std::tie(a.low, a.high, a.open_high) < std::tie(b.low, b.high, b.open_high);
}

bool same(const MeasureRange& a, const MeasureRange& b) { return !below(a, b) && !below(b, a); }

/// Between two neighbours: the middle of the gap, or of both middles within the overlap.
double border(const MeasureRange& below, const MeasureRange& above) {
    if (above.low >= below.high) return 0.5 * (double(below.high) + double(above.low));
    return std::clamp(0.5 * (below.middle() + above.middle()), double(above.low), double(below.high));
}

}  // namespace

MeasureSteps::MeasureSteps(const GarmentSizes& garment, size_t measure) {
    for (const SizeRow& row : garment.sizes) ranges_.push_back(row.ranges[measure]);
    std::sort(ranges_.begin(), ranges_.end(), below);
    ranges_.erase(std::unique(ranges_.begin(), ranges_.end(), same), ranges_.end());
    for (const SizeRow& row : garment.sizes)
        of_row_.push_back(size_t(
            std::lower_bound(ranges_.begin(), ranges_.end(), row.ranges[measure], below) - ranges_.begin()));
}

double MeasureSteps::low(size_t step) const {
    return step == 0 ? -kUnbounded : border(ranges_[step - 1], ranges_[step]);
}

double MeasureSteps::high(size_t step) const {
    return step + 1 == ranges_.size() ? kUnbounded : low(step + 1);
}

double MeasureSteps::scale() const {
    double widths = 0.0, middles = 0.0;
    for (const MeasureRange& r : ranges_) widths += r.width(), middles += r.middle();
    return std::max(widths, kSpread * middles) / double(ranges_.size());
}

}  // namespace vfit
