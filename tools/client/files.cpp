#include "client/files.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include "client/client.h"

namespace vfit::tools {

std::string read_text(const std::string& path) {
    std::error_code error;
    std::ifstream file;
    if (!std::filesystem::is_directory(path, error)) file.open(path, std::ios::binary);
    std::stringstream text;
    if (!file.is_open() || (text << file.rdbuf(), file.bad())) throw Failure(path + ": cannot be read");
    return text.str();
}

void create_folder(const std::string& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw Failure(path + ": cannot be made a folder: " + error.message());
}

void write_text(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) throw Failure(path + ": cannot be written");
}

}  // namespace vfit::tools
