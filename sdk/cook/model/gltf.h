// Takes the triangles and materials out of a glTF file.
#pragma once

#include <string>

#include "avatar/gltf_document.h"
#include "cook/model/beside.h"
#include "cook/model/model.h"

namespace vfit {

/// All meshes where the file's nodes put them, skinned ones as their bones stand; metres. file: its name, for
/// textures that lie inside of it. VFIT_ERROR_DATA and VFIT_ERROR_UNSUPPORTED name the mesh and its part.
Model read_gltf(const GltfDocument& document, const std::string& file, const Beside& beside);

}  // namespace vfit
