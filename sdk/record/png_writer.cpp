#include "record/png_writer.h"

#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <new>

#include "core/error.h"

namespace vfit {

namespace {

constexpr int kCompressionLevel = 1;  // zlib's fastest: a recorder keeps up with 30 Hz first of all

/// What libpng's callbacks write to. `message` is theirs when they jump.
struct Sink {
    std::vector<unsigned char>* bytes;
    char message[128];
};

void append(png_structp png, png_bytep data, size_t size) {
    auto* sink = static_cast<Sink*>(png_get_io_ptr(png));
    bool full = false;
    try {
        sink->bytes->insert(sink->bytes->end(), data, data + size);
    } catch (const std::bad_alloc&) {
        full = true;
    }
    if (full) png_error(png, "out of memory");
}

void keep_message(png_structp png, png_const_charp message) {
    auto* sink = static_cast<Sink*>(png_get_error_ptr(png));
    std::snprintf(sink->message, sizeof sink->message, "%s", message);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

/// No object with a destructor lives in here: libpng leaves it by longjmp.
bool encode(Sink* sink, const unsigned char* pixels, uint32_t width, uint32_t height, size_t row_stride,
            int color_type, int bit_depth) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, sink, keep_message, ignore_warning);
    if (!png) return false;
    png_infop info = png_create_info_struct(png);
    if (!info || setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_set_write_fn(png, sink, append, nullptr);
    png_set_compression_level(png, kCompressionLevel);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
    png_set_IHDR(png, info, width, height, bit_depth, color_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    if (bit_depth == 16) png_set_swap(png);  // PNG is big-endian, the targets are little-endian
    for (uint32_t y = 0; y < height; ++y) png_write_row(png, pixels + y * row_stride);
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    return true;
}

}  // namespace

void write_file_atomically(const std::string& path, const void* bytes, size_t size) {
    const std::string temporary = path + ".part";
    std::ofstream file(std::filesystem::path(temporary), std::ios::binary | std::ios::trunc);
    file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
    file.close();
    std::error_code error, ignored;
    if (file) std::filesystem::rename(temporary, path, error);
    if (file && !error) return;
    std::filesystem::remove(temporary, ignored);  // on a full disk the half-written file takes the last room
    if (error) fail(VFIT_ERROR_IO, path, ": cannot be renamed into place: ", error.message());
    fail(VFIT_ERROR_IO, path, ": cannot be written");
}

void PngWriter::write(const std::string& path, const void* pixels, uint32_t width, uint32_t height,
                      size_t row_stride, int color_type, int bit_depth) {
    encoded_.clear();
    Sink sink{&encoded_, "out of memory"};
    if (!encode(&sink, static_cast<const unsigned char*>(pixels), width, height, row_stride, color_type,
                bit_depth))
        fail(VFIT_ERROR_IO, path, ": cannot be encoded: ", sink.message);
    write_file_atomically(path, encoded_.data(), encoded_.size());
}

void PngWriter::write_grey16(const std::string& path, const void* pixels, uint32_t width, uint32_t height,
                             size_t row_stride) {
    write(path, pixels, width, height, row_stride, PNG_COLOR_TYPE_GRAY, 16);
}

void PngWriter::write_grey8(const std::string& path, const void* pixels, uint32_t width, uint32_t height,
                            size_t row_stride) {
    write(path, pixels, width, height, row_stride, PNG_COLOR_TYPE_GRAY, 8);
}

void PngWriter::write_rgba8(const std::string& path, const void* pixels, uint32_t width, uint32_t height,
                            size_t row_stride) {
    write(path, pixels, width, height, row_stride, PNG_COLOR_TYPE_RGB_ALPHA, 8);
}

}  // namespace vfit
