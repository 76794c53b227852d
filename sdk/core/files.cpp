#include "core/files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace vfit {

std::vector<std::byte> read_file(const std::string& path, size_t max_bytes) {
    std::ifstream file(std::filesystem::path(path), std::ios::binary | std::ios::ate);
    std::error_code ignored;
    const std::streamoff end = file ? std::streamoff(file.tellg()) : -1;  // -1 as well: a pipe has no length
    if (end < 0 || std::filesystem::is_directory(path, ignored))
        fail(VFIT_ERROR_IO, path, ": cannot be read");
    const auto size = static_cast<size_t>(end);
    if (size > max_bytes)
        fail(VFIT_ERROR_IO, path, ": ", size, " bytes are more than the ", max_bytes, " allowed");
    std::vector<std::byte> bytes(size);
    file.seekg(0);
    if (size > 0 && !file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        fail(VFIT_ERROR_IO, path, ": cannot be read to its end");
    return bytes;
}

std::vector<std::string> data_names(const std::string& data_dir, const std::string& kind) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(data_dir + "/" + kind, ignored))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string data_file(const std::string& data_dir, const std::string& kind, const std::string& name) {
    const bool plain = !name.empty() && name.find_first_of("/\\:") == std::string::npos && name[0] != '.';
    if (!plain) fail(VFIT_ERROR_ARGUMENT, "\"", name, "\" is not the name of a file in ", kind);
    const std::string path = data_dir + "/" + kind + "/" + name + ".json";
    std::error_code ignored;
    if (std::filesystem::exists(path, ignored)) return path;
    std::string known;
    for (const std::string& other : data_names(data_dir, kind)) known += (known.empty() ? "" : ", ") + other;
    fail(VFIT_ERROR_IO, "there is no \"", name, "\" in ", kind,
         "; there are: ", known.empty() ? "none" : known);
}

}  // namespace vfit
