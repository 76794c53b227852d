// Size charts, populations and garments: by name those that come with vfit, by path one's own.
#pragma once

#include <string>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

/// A path has a slash in it or ends in ".json"; anything else is a name.
SizeChart open_chart(vfit_context context, const std::string& name_or_path);
/// Names that open_garment and open_chart take.
std::vector<std::string> garment_names(vfit_context context);
std::vector<std::string> chart_names(vfit_context context);
Population open_population(vfit_context context, const std::string& name_or_path);
Garment open_garment(vfit_context context, const std::string& name_or_path);

}  // namespace vfit::tools
