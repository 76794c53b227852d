// From measurements to labels: how probable each size of a chart is, given how uncertain each measure is, and
// how a chosen size sits.
#pragma once

#include <string>
#include <vector>

#include "anthropometry/measurement.h"
#include "size/size_chart.h"

namespace vfit {

struct SizeProbability {
    std::string label;
    float probability = 0.0f;
};

/// Every label of that garment, best first; the probabilities sum to 1. A measure's value is taken as normal
/// with its sigma; errors of one person's measures go partly together. A body's label is the one whose ranges
/// it misses least: the sum of the squared distances from them, in MeasureSteps::scale(), times the measure's
/// weight. Labels that it misses alike, because their ranges overlap about it, are ranked by the distances
/// from the middles in the same way. So the first and the last label also serve what lies beyond them, and a
/// gap between two is split in its middle. Measures that are not given are left out. None of the garment's
/// measures given: VFIT_ERROR_DATA naming them, but a garment of one label needs none. A garment that the
/// chart lacks: VFIT_ERROR_ARGUMENT.
std::vector<SizeProbability> recommend(const SizeChart& chart, const std::string& garment_kind,
                                       const std::vector<Measurement>& measurements);

/// How a size sits where one measure is.
struct SizeZone {
    std::string key;
    float ease = 0.0f;   // the middle of the size's range minus the body; MeasureRange::ease
    float sigma = 0.0f;  // of ease, one standard deviation
    float tight = 0.0f, regular = 0.0f, loose = 0.0f;  // probabilities: above, within, below the range
};

/// One zone a measure of the garment that was given. Errors as above; a label that the garment lacks, or one
/// of a table (which is no range of one measure): VFIT_ERROR_ARGUMENT.
std::vector<SizeZone> size_zones(const SizeChart& chart, const std::string& garment_kind,
                                 const std::string& label, const std::vector<Measurement>& measurements);

}  // namespace vfit
