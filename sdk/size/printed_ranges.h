// From the numbers that a chart prints for one measure to the ranges that its labels serve.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"
#include "size/measure_range.h"

namespace vfit {

/// As printed, in the chart's unit. A single value has equal ends.
struct PrintedRange {
    std::string label;  // of the size
    std::string place;  // for messages: garment, label and measure
    double low = 0.0, high = 0.0;
    bool open_low = false, open_high = false;
};

/// A number, or [low, high] with null for an open end. `unit` is what a number is worth in the measure's own
/// unit. VFIT_ERROR_DATA naming the place where it is neither, or not plausible.
PrintedRange read_printed_range(const Json& json, const std::string& key, double unit,
                                const std::string& label, const std::string& place);

/// Ranges of one measure, in the measure's own unit. From label to label neither end descends and at least
/// one ascends; ranges may meet, overlap or leave a gap. A single value is the middle of a size: it reaches
/// halfway to the ends of its neighbours, and the first and the last reach outwards as far as inwards. Only
/// the first label may be open below, and only the last above. VFIT_ERROR_DATA naming the place of a broken
/// rule.
std::vector<MeasureRange> ranges_of(const std::vector<PrintedRange>& printed, const std::string& key,
                                    double unit);

}  // namespace vfit
