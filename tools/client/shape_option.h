// The option --shape: shape values of a body as a text.
#pragma once

#include <string>
#include <vector>

#include "vfit.h"

namespace vfit::tools {

/// "height=0.7,weight=1".
std::vector<vfit_shape_value> shape_values(const std::string& text);

}  // namespace vfit::tools
