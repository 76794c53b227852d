// From a garment that is modelled as a mesh to a garment file's: made whole, draped on the default body of a
// sex, in its own lengths.
#pragma once

#include <string>

#include "cook/cook_pattern.h"
#include "cook/model/alignment.h"
#include "cook/model/model.h"

namespace vfit {

/// Whether what is simulated is made anew along the garment's outer side, and what was modelled is drawn on
/// it.
enum class Remake { where_needed, never, always };

struct ModelOptions {
    std::string name;
    CookOptions cook;
    AlignmentOptions alignment;
    Remake remake = Remake::where_needed;
    std::string size_label;  // empty: it has none
};

/// A file may hold several garments, as a suit does: the innermost first. VFIT_ERROR_DATA says what is no
/// garment's mesh, and where.
std::vector<CookedGarment> cook_model(const BodyModel& body_model, const Model& model,
                                      const FabricLibrary& fabrics, const ModelOptions& options, Jobs& jobs);

}  // namespace vfit
