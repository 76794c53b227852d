// Meshes of generated people, for tapes of others.
#pragma once

#include <memory>
#include <string>

#include "body/body_model.h"
#include "population/population.h"

namespace vfit::tools {

/// The mesh on which the person's girths are taken, as a Wavefront file: metres, Y up, facing +Z, with a
/// group for the faces of the arms. The joints that levels hang on are comments.
void write_mesh(const std::string& path, const std::shared_ptr<const BodyModel>& model,
                const PersonOfPopulation& person);

}  // namespace vfit::tools
