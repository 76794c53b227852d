#include "client/files.h"

#include <filesystem>
#include <fstream>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

std::string read_text(const std::string& path) {
    std::error_code error;
    std::ifstream file;
    if (!std::filesystem::is_directory(path, error)) file.open(path, std::ios::binary);
    if (!file.is_open()) throw Failure(path + ": cannot be read");
    // More than any file that a command reads, and an end for devices that have none.
    constexpr size_t kMaxBytes = size_t(256) << 20, kBlock = size_t(1) << 20;
    std::string text;
    std::vector<char> block(kBlock);
    while (file.read(block.data(), std::streamsize(kBlock)) || file.gcount() > 0) {
        text.append(block.data(), size_t(file.gcount()));
        if (text.size() > kMaxBytes) throw Failure(path + ": is larger than 256 MiB");
    }
    if (file.bad()) throw Failure(path + ": cannot be read");
    return text;
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

void replace_text(const std::string& path, const std::string& text) {
    std::error_code error;
    std::filesystem::path file(path);
    if (std::filesystem::exists(file, error)) {
        if (!std::filesystem::is_regular_file(file, error))
            return write_text(path, text);               // a pipe, a device
        file = std::filesystem::canonical(file, error);  // of a link
    }
    const std::string part = file.string() + ".part";
    try {
        write_text(part, text);
    } catch (const Failure&) {
        throw Failure(path + ": cannot be written");
    }
    std::filesystem::rename(part, file, error);
    if (error) throw Failure(path + ": cannot be written: " + error.message());
}

}  // namespace vfit::tools
