// Girths of a turn on the spot beside what the views before it make likely.
#pragma once

#include <array>
#include <vector>

#include "anthropometry/measurement.h"
#include "scan/seen_measures.h"
#include "vfit.h"

namespace vfit {

/// What a girth read off a turn's outline is off by: clothes, posture, and where body fitting puts the
/// levels.
struct TurnedGirth {
    float offset_m = 0.0f, sigma_m = 0.0f;
};
struct TurnedGirths {
    TurnedGirth chest, waist, hip;
};

/// Each girth that the turn shows is combined with the measure in the list: the mean of least variance of two
/// estimates whose errors correlate, as both hang on the fitted levels.
void combine_with_turn(std::vector<Measurement>& measures, const SeenMeasures& turned,
                       const TurnedGirths& errors);

}  // namespace vfit
