// Measures that the camera plainly sees: the crown's height, and girths of the trunk's sections at the levels
// of their definitions.
#pragma once

#include "scan/section_girths.h"
#include "scan/turned_trunk.h"

namespace vfit {

/// Metres; NaN where not seen. Nearly right for everybody whatever their form; what they are off by as a
/// whole (clothes, posture, the back's form) is left to the measure model.
struct SeenMeasures {
    float stature_m, chest_girth_m, waist_girth_m, hip_girth_m;
};

/// From the front and the side, where arms hide the chest. `female`: the waist's level differs by sex
/// (anthropometry/tape_landmarks.h).
SeenMeasures seen_measures(float crown_m, const SectionGirths& girths, bool female);

/// From all around; no stature. `female`: the chest is that of the bust points; else the largest girth below
/// the armpits.
SeenMeasures seen_measures(const TurnedTrunk& trunk, bool female);

}  // namespace vfit
