// Where files stand that belong to the library.
#pragma once

#include <string>

namespace vfit::tools {

/// Of a file beside the library, as "vfit_data/body.bin".
std::string library_file(const std::string& name);

}  // namespace vfit::tools
