// Reads the polygons and materials of an OBJ file.
#pragma once

#include <string_view>

#include "cook/model/beside.h"
#include "cook/model/model.h"

namespace vfit {

/// v, vt, f, usemtl and mtllib with Kd and map_Kd; normals, groups, lines and points are passed over.
/// VFIT_ERROR_DATA names the line, VFIT_ERROR_UNSUPPORTED that of a curved surface.
Model read_obj(std::string_view text, const Beside& beside);

}  // namespace vfit
