// Measures that the camera plainly sees, without learning: the crown's height, and girths of the trunk about
// what its outline from the front and from the side and its depth tell of a section.
#pragma once

#include "scan/body_scan.h"

namespace vfit {

/// Metres; NaN where not seen. Nearly right for everybody whatever their form; what they are off by as a
/// whole (clothes, posture, the back's form) is left to the measure model.
struct SeenMeasures {
    float stature_m, waist_girth_m, hip_girth_m;
};

/// `female`: the waist's level differs by sex (measure/tape_landmarks.h).
SeenMeasures seen_measures(const ScanFeatures& features, bool female);

}  // namespace vfit
