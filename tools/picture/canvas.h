// A picture to draw on (OpenCV) and PNG files of it (libpng: OpenCV's own codecs weigh 125 MB).
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

namespace vfit::tools {

struct Color {
    float r = 0, g = 0, b = 0;  // 0..1, as shown (sRGB)
};

inline Color mix(const Color& a, const Color& b, float t) {
    return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t};
}

/// 8-bit RGB, origin top left. Drawing is anti-aliased; what lies outside is left out.
class Canvas {
public:
    Canvas(int width, int height, const Color& background = {});
    // cv::Mat shares its pixels when copied; a picture does not.
    Canvas(const Canvas& other) : image_(other.image_.clone()) {}
    Canvas(Canvas&&) = default;
    Canvas& operator=(Canvas other) {
        image_ = other.image_;
        return *this;
    }

    int width() const { return image_.cols; }
    int height() const { return image_.rows; }

    void set(int x, int y, const Color& color, float alpha = 1.0f);
    Color get(int x, int y) const;

    void fill_rect(int x, int y, int width, int height, const Color& color);
    void line(float x0, float y0, float x1, float y1, int thickness, const Color& color);
    void disc(float x, float y, float radius, const Color& color);
    void ring(float x, float y, float radius, int thickness, const Color& color);
    /// `height` of a capital letter in pixels; (x, y) is the left end of the base line.
    void text(int x, int y, const std::string& text, int height, const Color& color);
    static int text_width(const std::string& text, int height);

    /// Another picture, resized into a rectangle.
    void blit(const Canvas& from, int x, int y, int width, int height);

    void write_png(const std::string& path) const;

private:
    cv::Mat image_;  // CV_8UC3, RGB
};

/// One 8-bit channel.
void write_grey_png(const std::string& path, const uint8_t* pixels, uint32_t width, uint32_t height,
                    uint32_t row_stride);

}  // namespace vfit::tools
