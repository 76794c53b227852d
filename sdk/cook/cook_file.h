// Cooks whatever a garment's author brings: the kind of the file is seen by what is in it.
#pragma once

#include <string>

#include "cook/cook_model.h"

namespace vfit {

struct CookRequest {
    std::string path;
    // Empty: as the file tells, or as CookOptions has it.
    std::string name, kind, fabric, size_chart;
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    // The body that it is made on: a file of measures, or shape values; without both, of a specification the
    // measures that lie beside it.
    std::string measures;
    std::vector<ShapeSetting> shape;
    // Of a mesh: the unit of its numbers (0: metres, or what makes it a garment that fits), by how much it is
    // scaled (0: not by hand), by what it is placed, and the label of its size (empty: none).
    float unit_m = 0.0f, scale = 0.0f;
    StandsBy stands_by = StandsBy::any;
    Remake remake = Remake::where_needed;
    std::string size_label;
    float triangle_m = 0.02f;
    DrapeSettings drape;
};

/// By its ending, whether it is a mesh.
bool is_mesh_file(const std::string& path);

/// By what is in it, whether a JSON file is a specification or a design. VFIT_ERROR_DATA where it is no JSON.
bool is_design_file(const std::string& path);

/// The garments in a file, the innermost first. VFIT_ERROR_DATA says what is wrong with it;
/// VFIT_ERROR_UNSUPPORTED that it is none of the kinds that are known.
std::vector<CookedGarment> cook_file(const BodyModel& model, const FabricLibrary& fabrics,
                                     const CookRequest& request, Jobs& jobs);

}  // namespace vfit
