#include "picture.h"

#include <epoxy/gl.h>
#include <png.h>

#include "abi.h"

namespace room {

void Picture::read(int width, int height) {
    width_ = width, height_ = height;
    rgb_.resize(size_t(width) * size_t(height) * 3);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, rgb_.data());
}

void Picture::write_png(const std::string& path) const {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(width_);
    image.height = png_uint_32(height_);
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;
    // OpenGL's first row is the lowest.
    if (!png_image_write_to_file(&image, path.c_str(), 0, rgb_.data(), -3 * width_, nullptr))
        throw Failure(path + ": cannot be written: " + image.message);
}

}  // namespace room
