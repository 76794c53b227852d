// Drafts a garment as a cutter does, from the measures of a size and a small design, into a sewing pattern
// for each size. The blocks (torso, sleeve, skirt, trousers, band) are flat constructions of their own, one a
// file; the design says which of them the garment has.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "anthropometry/measurement.h"
#include "body/body_model.h"
#include "cook/pattern/pattern.h"

namespace vfit {

enum class BodyLevel { waist, hip, knee, ankle };

/// A height as a share of the way from one level of the body to another.
struct LevelShare {
    BodyLevel from = BodyLevel::waist, to = BodyLevel::hip;
    float share = 0.0f;
};

struct TorsoDesign {
    enum class Front { whole, closed, open };  // one piece, two pieces sewn in the middle, two that are not
    Front front = Front::whole;
    bool back_seam = false;  // two pieces, sewn down the middle
    float chest_ease_m = 0.0f, waist_ease_m = 0.0f,
          hip_ease_m = 0.0f;        // of the garment's girth over the body's
    std::optional<LevelShare> hem;  // none: it ends at the waist, where skirt or trousers are sewn on
    float length_ease_m =
        0.0f;            // over the way from shoulder to waist: what stands off the body has a longer one
    float flare = 0.0f;  // what each side seam goes outwards below the hips, metres a metre
    float neck_width_m = 0.0f;                            // of the neckline beyond the neck, each side
    float neck_depth_m = 0.0f, back_neck_depth_m = 0.0f;  // below the natural neckline
    bool v_neck = false;
    float collar_height_m = 0.0f;  // of a stand-up collar; 0: none
    float shoulder = 1.0f;         // end of the shoulder seam: share of the way from the neck to the acromion
    float armhole_drop_m = 0.0f;   // of the underarm point below the armpit
    float bust_dart = 0.0f;        // dart from the side: share of what the front is longer than the back
    float waist_dart =
        0.0f;  // share of the shaping between chest and waist that goes into darts, not the side seam
};

struct SleeveDesign {
    float length = 1.0f;        // share of the arm's length
    float width_ease_m = 0.0f;  // over the upper arm's girth
    float hem_ease_m = 0.0f;    // over the arm's girth at the hem
    float cap_ease = 0.0f;      // what the sleeve's cap is longer than the armhole, share
};

struct SkirtDesign {
    float hip_ease_m = 0.0f;
    LevelShare hem;
    float flare =
        0.0f;  // what each side seam turns outwards below the hips, beside the cone from waist to hips
};

struct TrousersDesign {
    float waist_ease_m = 0.0f, hip_ease_m = 0.0f;
    float rise = 0.0f;           // of the upper edge: share of the way from the waist down to the hips
    float crotch_ease_m = 0.0f;  // below the body's crotch
    float fork =
        0.16f;  // what both pieces of a leg reach beyond the middle: share of the garment's hip girth
    float knee_ease_m = 0.0f, hem_ease_m = 0.0f;  // over the girths of knee and ankle
    LevelShare hem;
    float dart = 0.0f;  // share of the back's shaping between hips and waist that goes into a dart; 0: none
    float band_height_m = 0.0f;  // of the waistband; 0: none
    float gather = 0.0f;         // what the trousers' edge is longer than the band, share
};

struct GarmentDesign {
    std::string name, fabric;
    std::string kind, size_chart;  // of the size charts; size_chart may be empty
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    std::array<float, 3> color{0.8f, 0.8f, 0.8f};
    std::optional<TorsoDesign> torso;
    std::optional<SleeveDesign> sleeve;
    std::optional<SkirtDesign> skirt;
    std::optional<TrousersDesign> trousers;
    std::vector<std::vector<Measurement>> girths;  // of the sizes: chest, waist and, where known, hips
    std::vector<std::string> labels;               // one a size
};

/// Format "vfit-design" version 1; VFIT_ERROR_DATA names the field.
GarmentDesign parse_design(std::span<const std::byte> json);

struct DraftedSize {
    std::string label;
    std::vector<Measurement> nominal;  // girths of the body that it is made for
    // The garment's own, flat, in the same places; "x_top_girth_m" is that of an upper edge below the waist.
    std::vector<Measurement> finished;
    Pattern pattern;
};

struct DraftedGarment {
    std::vector<DraftedSize> sizes;  // the same panels, corners, edges and stitches in the same order
    size_t base = 0;  // made for girths nearest to the default body's: the chest, or waist and hips where
                      // there is no torso
};

/// On the model's default body of the design's sex. VFIT_ERROR_DATA names the size and what cannot be drawn.
DraftedGarment draft(const BodyModel& model, const GarmentDesign& design);

}  // namespace vfit
