#include "population/library_file.h"

#include <filesystem>

#include "core/platform.h"

namespace vfit::tools {

std::string library_file(const std::string& name) {
    return (std::filesystem::path(library_folder()) / ".." / "lib" / name).lexically_normal().string();
}

}  // namespace vfit::tools
