// Writes grey and RGBA pictures as PNG files that are complete before their name appears.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vfit {

class PngWriter {
public:
    /// row_stride is in bytes. Fails with VFIT_ERROR_IO, naming the file.
    void write_grey16(const std::string& path, const void* pixels, uint32_t width, uint32_t height,
                      size_t row_stride);
    void write_grey8(const std::string& path, const void* pixels, uint32_t width, uint32_t height,
                     size_t row_stride);
    void write_rgba8(const std::string& path, const void* pixels, uint32_t width, uint32_t height,
                     size_t row_stride);

private:
    void write(const std::string& path, const void* pixels, uint32_t width, uint32_t height,
               size_t row_stride, int color_type, int bit_depth);

    std::vector<unsigned char> encoded_;  // keeps its memory from picture to picture
};

/// A whole file at once: written under a temporary name, then renamed. Fails with VFIT_ERROR_IO.
void write_file_atomically(const std::string& path, const void* bytes, size_t size);

}  // namespace vfit
