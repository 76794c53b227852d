// Measures that the camera plainly sees: the crown's height, and girths of the trunk's sections at the levels
// of their definitions.
#pragma once

#include <cmath>
#include <string_view>

#include "scan/section_girths.h"
#include "scan/turned_trunk.h"

namespace vfit {

/// Metres; NaN where not seen. Nearly right for everybody whatever their form; what they are off by as a
/// whole (clothes, posture, the back's form) is left to the measure model.
struct SeenMeasures {
    float stature_m = std::nanf(""), chest_girth_m = std::nanf(""), waist_girth_m = std::nanf(""),
          hip_girth_m = std::nanf(""), waist_navel_girth_m = std::nanf(""),
          waist_minimum_girth_m = std::nanf("");

    /// NaN of other keys.
    float of(std::string_view key) const;
};

/// From the front and the side, where arms hide the chest. `female`: levels differ by sex
/// (anthropometry/tape_landmarks.h).
SeenMeasures seen_measures(float crown_m, const SectionGirths& girths, bool female);

/// From all around; no stature. `female`: the chest is that of the bust points; else the largest girth up to
/// where people's armpits lie.
SeenMeasures seen_measures(const TurnedTrunk& trunk, bool female);

/// By the levels of each sex.
struct SeenOfTurn {
    explicit SeenOfTurn(const TurnedTrunk& trunk, float doubt = 1.0f, bool by_cameras = false)
        : male(seen_measures(trunk, false)),
          female(seen_measures(trunk, true)),
          doubt(doubt),
          by_cameras(by_cameras) {}

    SeenMeasures male, female;
    float doubt;      // how many times wider its errors are than those that were learnt
    bool by_cameras;  // a few views from all around instead of a turn
};

}  // namespace vfit
