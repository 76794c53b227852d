// Measures that the camera plainly sees: the crown's height, and girths of the trunk's sections at the levels
// of their definitions.
#pragma once

#include "scan/section_girths.h"

namespace vfit {

/// Metres; NaN where not seen. Nearly right for everybody whatever their form; what they are off by as a
/// whole (clothes, posture, the back's form) is left to the measure model.
struct SeenMeasures {
    float stature_m, chest_girth_m, waist_girth_m, hip_girth_m;
};

/// `female`: the waist's level differs by sex (measure/tape_landmarks.h).
SeenMeasures seen_measures(float crown_m, const SectionGirths& girths, bool female);

}  // namespace vfit
