// What is measured of a generated body, and its mesh.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "avatar/body_with_measures.h"

namespace vfit::tools {

/// Every tape measure of the body, and the trunk's "navel_girth_m", "navel_breadth_m" and "navel_depth_m" at
/// that fraction of its stature.
BodyMeasures measures_of(const std::shared_ptr<const BodyModel>& model, vfit_sex sex,
                         const std::vector<float>& shape, double navel_share);

/// The mesh on which those are taken, as a Wavefront file for tapes of others: metres, Y up, facing +Z, with
/// a group for the faces of the arms. The joints that levels hang on are comments.
void write_mesh(const std::string& path, const std::shared_ptr<const BodyModel>& model, vfit_sex sex,
                const std::vector<float>& shape);

}  // namespace vfit::tools
