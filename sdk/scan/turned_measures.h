// Girths of a turn on the spot beside what the views before it make likely.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "anthropometry/measurement.h"
#include "scan/seen_measures.h"
#include "vfit.h"

namespace vfit {

/// What a girth read off a turn's closed surface is off by: clothes, posture, and where body fitting puts the
/// levels.
struct TurnedGirth {
    float offset_m = 0.0f, sigma_m = 0.0f;
};
inline constexpr std::array<std::string_view, 5> kTurnedKeys = {
    "chest_girth_m", "waist_girth_m", "hip_girth_m", "waist_navel_girth_m", "waist_minimum_girth_m"};
using TurnedGirths = std::array<TurnedGirth, kTurnedKeys.size()>;

/// Each girth that the turn shows is combined with the measure in the list: the mean of least variance of two
/// estimates whose errors correlate, as both hang on the fitted levels. `doubt`: how many times wider the
/// errors are than those that were learnt.
void combine_with_turn(std::vector<Measurement>& measures, const SeenMeasures& turned,
                       const TurnedGirths& errors, float doubt);

}  // namespace vfit
