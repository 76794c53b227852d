// From a sewing pattern, in one or several sizes, to a garment: meshed, sewn, draped on a body.
#pragma once

#include <string>
#include <vector>

#include "body/body_model.h"
#include "body/shape_setting.h"
#include "cloth/fabric/fabric_library.h"
#include "cloth/garment/garment.h"
#include "cook/drape/drape.h"
#include "cook/pattern/pattern.h"
#include "core/jobs.h"

namespace vfit {

/// A pattern in one size. Of one garment all have the same panels, edges and stitches.
struct PatternSize {
    std::string label;                 // may be empty where there is only one
    std::vector<Measurement> nominal;  // girths that it is made for
    Pattern pattern;
};

struct CookOptions {
    std::string kind = "dress";
    bool kind_told = false;  // the garment has to go round what its kind does
    std::string fabric = "cotton_woven";
    std::string size_chart;  // name of the chart that the labels follow; empty: not stated
    vfit_sex sex = VFIT_SEX_FEMALE;
    std::vector<ShapeSetting> shape;  // of the body that it is made on; empty: the default one of the sex
    float triangle_m = 0.02f;         // side
    DrapeSettings drape;
};

struct CookedGarment {
    Garment garment;
    std::string of_set;  // which of the garments in its file: "trousers"; empty: the only one
    DrapeReport report;
    std::vector<std::string> round;  // what it goes round (worn.h)
    std::vector<std::string> notes;  // of what was mended, left out, not found, or is to be looked at
    std::vector<float> openings_m;   // of a modelled garment: around each
};

uint32_t crossings_of(const std::vector<CookedGarment>& garments);

/// Triangles and seams agree on which side of the cloth is out, not on which of the two it is: that which
/// looks away from the body.
void turn_outside_out(Garment& garment, const MeshQuery& skin);

/// What is to be looked at in how it lies.
void add_drape_notes(const DrapeReport& report, std::vector<std::string>& notes);

/// base: the size that is draped; the others have its mesh in their own lengths. What crosses itself or the
/// skin is draped again, up to three times, with triangles of a slightly other size. VFIT_ERROR_DATA names
/// the panel, stitch or size.
CookedGarment cook_pattern(const BodyModel& model, const std::vector<PatternSize>& sizes, size_t base,
                           const FabricLibrary& fabrics, const CookOptions& options, Jobs& jobs);

}  // namespace vfit
