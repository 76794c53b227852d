#include "png_reader.h"

#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "support/failure.h"

namespace recording {

using plugin::fail;

namespace {

constexpr uint32_t kMaxSide = 16384;        // pixels
constexpr size_t kMaxChunk = 1 << 20;       // bytes of an ancillary chunk
constexpr size_t kFileAllowance = 1 << 20;  // bytes of a file beyond its uncompressed pixels
constexpr int kColor = 0;                   // in place of a bit depth: any picture, as RGBA8

struct Source {
    const unsigned char* bytes;
    size_t size, at;
    char message[160];
};

struct Picture {
    uint32_t width, height;
    int bit_depth;  // of a grey picture, or kColor
    unsigned char* pixels;
    size_t row_stride;
};

void take_bytes(png_structp png, png_bytep out, size_t count) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (count > source->size - source->at) png_error(png, "the file is cut");
    std::memcpy(out, source->bytes + source->at, count);
    source->at += count;
}

void keep_message(png_structp png, png_const_charp message) {
    auto* source = static_cast<Source*>(png_get_error_ptr(png));
    std::snprintf(source->message, sizeof source->message, "%s", message);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void check_header(png_structp png, png_infop info, const Picture& want) {
    char why[128];
    const uint32_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
    if (width != want.width || height != want.height) {
        std::snprintf(why, sizeof why, "has %u x %u pixels, camera.json says %u x %u", width, height,
                      want.width, want.height);
        png_error(png, why);
    }
    if (want.bit_depth == kColor) return;
    const int depth = png_get_bit_depth(png, info);
    if (png_get_color_type(png, info) == PNG_COLOR_TYPE_GRAY && depth == want.bit_depth) return;
    std::snprintf(why, sizeof why, "is not %d-bit grey (it has %d bits, colour type %d)", want.bit_depth,
                  depth, png_get_color_type(png, info));
    png_error(png, why);
}

/// No object with a destructor lives in here: libpng leaves it by longjmp.
bool decode(Source* source, const Picture& want) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, source, keep_message, ignore_warning);
    if (!png) return false;
    png_infop info = png_create_info_struct(png);
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_read_struct(&png, &info, nullptr);
        return false;
    }
    png_set_read_fn(png, source, take_bytes);
    png_set_user_limits(png, kMaxSide, kMaxSide);
    png_set_chunk_malloc_max(png, kMaxChunk);
    png_read_info(png, info);
    check_header(png, info, want);
    if (want.bit_depth == 16) png_set_swap(png);  // PNG is big-endian, the targets are little-endian
    if (want.bit_depth == kColor) {
        png_set_expand(png);
        png_set_strip_16(png);
        png_set_gray_to_rgb(png);
        png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    }
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    const size_t row_bytes = png_get_rowbytes(png, info);
    if (row_bytes > want.row_stride) png_error(png, "has rows that are too long");
    for (int pass = 0; pass < passes; ++pass)
        for (uint32_t y = 0; y < want.height; ++y)
            png_read_row(png, want.pixels + y * want.row_stride, nullptr);
    png_read_end(png, nullptr);
    png_destroy_read_struct(&png, &info, nullptr);
    return true;
}

}  // namespace

void PngReader::read_file(const std::filesystem::path& path, size_t largest) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? std::streamoff(file.tellg()) : -1;
    if (size < 0) fail(VFIT_ERROR_IO, path.string(), ": cannot be read");
    if (static_cast<uintmax_t>(size) > largest)
        fail(VFIT_ERROR_DATA, path.string(), ": has ", size, " bytes, more than its pixels can need");
    bytes_.resize(static_cast<size_t>(size));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(bytes_.data()), size);
    if (!file) fail(VFIT_ERROR_IO, path.string(), ": cannot be read");
}

void PngReader::read(const std::filesystem::path& path, uint32_t width, uint32_t height, int bit_depth,
                     void* pixels, size_t row_stride) {
    read_file(path, size_t(width) * height * 8 + kFileAllowance);
    Source source{bytes_.data(), bytes_.size(), 0, "out of memory"};
    const Picture want{width, height, bit_depth, static_cast<unsigned char*>(pixels), row_stride};
    if (!decode(&source, want))
        fail(VFIT_ERROR_DATA, path.string(), ": is no readable image: ", source.message);
}

void PngReader::read_grey16(const std::filesystem::path& path, uint32_t width, uint32_t height, void* pixels,
                            size_t row_stride) {
    read(path, width, height, 16, pixels, row_stride);
}

void PngReader::read_grey8(const std::filesystem::path& path, uint32_t width, uint32_t height, void* pixels,
                           size_t row_stride) {
    read(path, width, height, 8, pixels, row_stride);
}

void PngReader::read_rgba8(const std::filesystem::path& path, uint32_t width, uint32_t height, void* pixels,
                           size_t row_stride) {
    read(path, width, height, kColor, pixels, row_stride);
}

}  // namespace recording
