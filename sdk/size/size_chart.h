// Size charts as data: which label of which garment serves which ranges of which measures
// (docs/size-charts.md).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "size/measure_range.h"

namespace vfit {

/// A label and the ranges that it serves. A label of a table has several rows.
struct SizeRow {
    std::string label;
    std::vector<MeasureRange> ranges;  // one a measure of the garment, in its order
};

struct GarmentSizes {
    std::string kind;                   // "short_sleeves"
    std::vector<std::string> measures;  // none: a garment of one label that serves everyone
    std::vector<float> weights;         // one a measure: how much it counts against the others
    std::vector<SizeRow> sizes;         // of a list: smallest first
    std::vector<std::string> labels;    // each once, in the chart's order
};

class SizeChart {
public:
    /// VFIT_ERROR_DATA (VFIT_ERROR_VERSION for another version) with a sentence that names garment, label and
    /// measure where the text is not a chart.
    static SizeChart parse(std::string_view json);

    const std::string& name() const { return name_; }
    const std::string& source() const { return source_; }
    const std::vector<GarmentSizes>& garments() const { return garments_; }
    /// VFIT_ERROR_ARGUMENT naming the kinds that the chart has.
    const GarmentSizes& garment(const std::string& kind) const;

private:
    std::string name_, source_;
    std::vector<GarmentSizes> garments_;
};

}  // namespace vfit
