#include "offline/data_beside.h"

#include <filesystem>

#include "core/platform.h"

namespace vfit::tools {

std::string data_beside(const std::string& name) {
    const std::string prefix = library_folder() + "/../", file = "/vfit_data/" + name;
    const std::string built = prefix + "lib" + file;
    return std::filesystem::exists(built) ? built : prefix + VFIT_LIBDIR + file;
}

}  // namespace vfit::tools
