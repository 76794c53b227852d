#include "picture/canvas.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "client/client.h"

namespace vfit::tools {

namespace {

constexpr int kShift = 4;  // fractional bits of OpenCV's drawing coordinates
constexpr int kFont = cv::FONT_HERSHEY_DUPLEX;
constexpr double kFontHeight = 21.0;  // of a capital of that font at scale 1, pixels

uint8_t byte(float x) { return static_cast<uint8_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 255.0f)); }

cv::Scalar scalar(const Color& c) { return {double(byte(c.r)), double(byte(c.g)), double(byte(c.b))}; }

cv::Point fixed(float x, float y) {
    const auto f = [](float v) {
        return static_cast<int>(std::lround(std::clamp(v, -1e5f, 1e5f) * (1 << kShift)));
    };
    return {f(x), f(y)};
}

void write_png(const std::string& path, const void* pixels, uint32_t width, uint32_t height,
               uint32_t row_stride, uint32_t format) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = format;
    if (!png_image_write_to_file(&image, path.c_str(), 0, pixels, static_cast<png_int_32>(row_stride),
                                 nullptr))
        throw Failure(path + ": cannot be written: " + image.message);
}

}  // namespace

Canvas::Canvas(int width, int height, const Color& background)
    : image_(height, width, CV_8UC3, scalar(background)) {}

void Canvas::set(int x, int y, const Color& color, float alpha) {
    if (x < 0 || y < 0 || x >= width() || y >= height()) return;
    const Color c = alpha >= 1.0f ? color : mix(get(x, y), color, alpha);
    image_.at<cv::Vec3b>(y, x) = {byte(c.r), byte(c.g), byte(c.b)};
}

Color Canvas::get(int x, int y) const {
    const auto& p = image_.at<cv::Vec3b>(y, x);
    return {p[0] / 255.0f, p[1] / 255.0f, p[2] / 255.0f};
}

void Canvas::fill_rect(int x, int y, int width, int height, const Color& color) {
    cv::rectangle(image_, cv::Rect(x, y, width, height), scalar(color), cv::FILLED);
}

void Canvas::line(float x0, float y0, float x1, float y1, int thickness, const Color& color) {
    cv::line(image_, fixed(x0, y0), fixed(x1, y1), scalar(color), thickness, cv::LINE_AA, kShift);
}

void Canvas::disc(float x, float y, float radius, const Color& color) {
    cv::circle(image_, fixed(x, y), fixed(radius, 0).x, scalar(color), cv::FILLED, cv::LINE_AA, kShift);
}

void Canvas::ring(float x, float y, float radius, int thickness, const Color& color) {
    cv::circle(image_, fixed(x, y), fixed(radius, 0).x, scalar(color), thickness, cv::LINE_AA, kShift);
}

void Canvas::text(int x, int y, const std::string& text, int height, const Color& color) {
    const int thickness = std::max(1, height / 16);
    cv::putText(image_, text, {x, y}, kFont, height / kFontHeight, scalar(color), thickness, cv::LINE_AA);
}

int Canvas::text_width(const std::string& text, int height) {
    int base = 0;
    return cv::getTextSize(text, kFont, height / kFontHeight, std::max(1, height / 16), &base).width;
}

void Canvas::blit(const Canvas& from, int x, int y, int width, int height) {
    cv::Mat sized;
    const bool smaller = width < from.width();
    cv::resize(from.image_, sized, {width, height}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
    const cv::Rect target = cv::Rect(x, y, width, height) & cv::Rect(0, 0, this->width(), this->height());
    if (target.empty()) return;
    sized(cv::Rect(target.x - x, target.y - y, target.width, target.height)).copyTo(image_(target));
}

void Canvas::write_png(const std::string& path) const {
    tools::write_png(path, image_.data, static_cast<uint32_t>(image_.cols),
                     static_cast<uint32_t>(image_.rows), static_cast<uint32_t>(image_.step), PNG_FORMAT_RGB);
}

void write_grey_png(const std::string& path, const uint8_t* pixels, uint32_t width, uint32_t height,
                    uint32_t row_stride) {
    tools::write_png(path, pixels, width, height, row_stride, PNG_FORMAT_GRAY);
}

}  // namespace vfit::tools
