// Cooks whatever a garment's author brings: the kind of the file is seen by what is in it.
#pragma once

#include <string>

#include "cook/cook_pattern.h"

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
    // Of a mesh: the unit of an OBJ file's numbers, and the label of its size (empty: none).
    float unit_m = 1.0f;
    std::string size_label;
    float triangle_m = 0.02f;
    DrapeSettings drape;
};

/// By its ending, whether it is a mesh.
bool is_mesh_file(const std::string& path);

/// VFIT_ERROR_DATA says what is wrong with it; VFIT_ERROR_UNSUPPORTED that it is none of the kinds that are
/// known.
CookedGarment cook_file(const BodyModel& model, const FabricLibrary& fabrics, const CookRequest& request,
                        Jobs& jobs);

}  // namespace vfit
