// Data that tests may use and the project does not contain.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace vfit::test {

/// A file or folder in shared/data; empty where it is not there.
inline std::string shared_data(const std::string& name) {
    const char* told = std::getenv("VFIT_SHARED");
    const std::string path = (told ? told : VFIT_SOURCE_DIR "/../shared") + ("/data/" + name);
    return std::filesystem::exists(path) ? path : std::string();
}

}  // namespace vfit::test
