// The labels of a garment as one measure tells them apart.
#pragma once

#include <cstddef>
#include <vector>

#include "size/size_chart.h"

namespace vfit {

/// Rows with the same range are one step; steps ascend.
class MeasureSteps {
public:
    MeasureSteps(const GarmentSizes& garment, size_t measure);

    const std::vector<MeasureRange>& ranges() const { return ranges_; }
    size_t of_row(size_t row) const { return of_row_[row]; }

    /// The values that this measure alone gives to the step: those that miss no other range by less and,
    /// within several ranges, are nearest to its middle. From -infinity to infinity without a gap.
    double low(size_t step) const;
    double high(size_t step) const;

    /// The unit of distances where measures are compared: the mean width of a range, but not less than what
    /// people of one size differ by in a measure.
    double scale() const;

private:
    std::vector<MeasureRange> ranges_;
    std::vector<size_t> of_row_;
};

}  // namespace vfit
