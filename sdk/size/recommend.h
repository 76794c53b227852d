// From measurements to labels: how probable each size of a chart is, given how uncertain each measure is.
#pragma once

#include <string>
#include <vector>

#include "measure/measurement.h"
#include "size/size_chart.h"

namespace vfit {

struct SizeProbability {
    std::string label;
    float probability = 0.0f;
};

/// Every label of that garment, best first; the probabilities sum to 1. A measure's value is taken as normal
/// with its sigma and integrated over each label's range; the first and the last label also take what lies
/// beyond them, and a gap between two labels is split in its middle. Measures count as independent; those
/// that are not given are left out. None of the garment's measures given: VFIT_ERROR_DATA naming them. A
/// garment that the chart lacks: VFIT_ERROR_ARGUMENT.
std::vector<SizeProbability> recommend(const SizeChart& chart, const std::string& garment_kind,
                                       const std::vector<Measurement>& measurements);

}  // namespace vfit
