// Data of vfit for commands that work without the library: body and fabrics.
#pragma once

#include <string>

namespace vfit::tools {

/// A file of data beside the program: of a build, or of an installation with its own name for lib.
std::string data_beside(const std::string& name);

}  // namespace vfit::tools
