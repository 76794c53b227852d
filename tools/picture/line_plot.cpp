#include "picture/line_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vfit::tools {

namespace {

constexpr int kLeft = 90, kRight = 30, kTop = 60, kBottom = 70;  // pixels
constexpr Color kPaper{1, 1, 1}, kInk{0.16f, 0.17f, 0.20f}, kGrid{0.88f, 0.88f, 0.90f}, kLine{0.80f, 0.27f, 0.30f};

/// The step of 1, 2 or 5 times a power of ten that cuts the range in about five.
float nice_step(float range) {
    const float raw = range / 5.0f, power = std::pow(10.0f, std::floor(std::log10(raw)));
    for (const float f : {1.0f, 2.0f, 5.0f})
        if (raw <= f * power) return f * power;
    return 10.0f * power;
}

std::string number(float x) {
    char text[24];
    std::snprintf(text, sizeof text, "%g", double(std::round(x * 1e4f) / 1e4f));
    return text;
}

}  // namespace

Canvas draw_curve(const Curve& curve, int width, int height) {
    Canvas canvas(width, height, kPaper);
    canvas.text(kLeft, 36, curve.title, 17, kInk);
    float x0 = 0.0f, x1 = 1e-6f, y1 = 1e-6f;
    for (const auto& [x, y] : curve.points) {
        x1 = std::max(x1, x);
        y1 = std::max(y1, y);
    }
    const float y_step = nice_step(y1), x_step = nice_step(x1 - x0);
    y1 = std::ceil(y1 / y_step) * y_step;
    const auto px = [&](float x) { return float(kLeft) + (x - x0) / (x1 - x0) * float(width - kLeft - kRight); };
    const auto py = [&](float y) { return float(height - kBottom) - y / y1 * float(height - kTop - kBottom); };
    for (int i = 0; float(i) * y_step <= y1 * 1.001f; ++i) {
        const float y = float(i) * y_step;
        canvas.line(px(x0), py(y), px(x1), py(y), 1, kGrid);
        const std::string label = number(y);
        canvas.text(kLeft - 10 - Canvas::text_width(label, 11), static_cast<int>(py(y)) + 5, label, 11, kInk);
    }
    for (int i = 0; float(i) * x_step <= x1 * 1.001f; ++i)
        canvas.text(static_cast<int>(px(float(i) * x_step)) - 5, height - kBottom + 22, number(float(i) * x_step), 11, kInk);
    canvas.line(px(x0), py(0), px(x1), py(0), 1, kInk);
    for (size_t i = 1; i < curve.points.size(); ++i)
        canvas.line(px(curve.points[i - 1].first), py(curve.points[i - 1].second), px(curve.points[i].first),
                    py(curve.points[i].second), 2, kLine);
    canvas.text(width - kRight - Canvas::text_width(curve.x_label, 12), height - 20, curve.x_label, 12, kInk);
    canvas.text(kLeft, kTop - 6, curve.y_label, 11, kInk);
    return canvas;
}

}  // namespace vfit::tools
