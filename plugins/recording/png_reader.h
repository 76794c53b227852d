// Reads one picture of known size straight into a frame. PNG files come from outside: whatever is in them
// ends as pixels or as a sentence.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace recording {

class PngReader {
public:
    /// All fail with VFIT_ERROR_IO or VFIT_ERROR_DATA, naming the file; then `pixels` holds anything.
    /// Depth must be 16-bit grey, a mask 8-bit grey; colour may be anything and becomes RGBA8.
    void read_grey16(const std::filesystem::path& path, uint32_t width, uint32_t height, void* pixels,
                     size_t row_stride);
    void read_grey8(const std::filesystem::path& path, uint32_t width, uint32_t height, void* pixels,
                    size_t row_stride);
    void read_rgba8(const std::filesystem::path& path, uint32_t width, uint32_t height, void* pixels,
                    size_t row_stride);

private:
    void read_file(const std::filesystem::path& path, size_t largest);
    void read(const std::filesystem::path& path, uint32_t width, uint32_t height, int bit_depth, void* pixels,
              size_t row_stride);

    std::vector<unsigned char> bytes_;  // keeps its memory from picture to picture
};

}  // namespace recording
