// What a cutter asks of a body: girths, lengths, widths and heights, taken from the default body and graded
// to a size.
#pragma once

#include <vector>

#include "body/body_model.h"
#include "cook/draft/draft.h"

namespace vfit {

/// Metres. Heights are above the soles and the same for every size: a letter does not imply a stature.
struct DraftMeasures {
    float chest = 0.0f, waist = 0.0f, hip = 0.0f, neck = 0.0f;  // girths
    float upper_arm = 0.0f, elbow = 0.0f, wrist = 0.0f;         // girths
    float thigh = 0.0f, knee = 0.0f, ankle = 0.0f;              // girths
    float front_length = 0.0f,
          back_length = 0.0f;      // over the skin from the side of the neck straight down to the waist
    float bust_length = 0.0f;      // over the skin from the side of the neck to the bust point
    float bust_half_m = 0.0f;      // from the middle to the bust point
    float shoulder_half_m = 0.0f;  // from the middle to the acromion
    float shoulder_slope_rad = 0.0f, shoulder_above_waist = 0.0f;  // the acromion's skin
    float arm_length = 0.0f;
    float armpit_above_waist = 0.0f, bust_above_waist = 0.0f, crotch_below_waist = 0.0f;
    float waist_height = 0.0f, hip_height = 0.0f, knee_height = 0.0f, ankle_height = 0.0f;

    /// Girth at a share of the way from waist (0) to hips (1): the default body's, scaled to these two
    /// girths.
    float girth_between(float share) const;
    std::vector<float>
        waist_to_hip;  // that body's shares of the way from waist girth to hip girth, at even heights

    float side_of_neck_m() const;  // half the width of the natural neckline
    float level(BodyLevel level) const;
    /// From the waist to the hips over the skin: down the side of a cone of those girths.
    float hip_depth() const;
    /// Below the waist.
    float depth(const LevelShare& place) const;
};

/// Takes them all from the model's default body, as it stands at rest.
DraftMeasures measure_default_body(const BodyModel& model, vfit_sex sex);

/// Of a body with these girths of chest, waist and, where known, hips, grown by the grade rules.
DraftMeasures graded(const DraftMeasures& body, const std::vector<Measurement>& girths);

}  // namespace vfit
