#include "picture/line_plot.h"

#include <algorithm>
#include <cmath>

#include "picture/axis.h"

namespace vfit::tools {

namespace {

constexpr int kLeft = 90, kRight = 30, kTop = 60, kBottom = 70;  // pixels
constexpr Color kPaper{1, 1, 1}, kInk{0.16f, 0.17f, 0.20f}, kGrid{0.88f, 0.88f, 0.90f},
    kMark{0.50f, 0.52f, 0.56f}, kLine{0.80f, 0.27f, 0.30f};
constexpr Color kBehind[] = {{0.55f, 0.60f, 0.72f}, {0.45f, 0.68f, 0.50f}, {0.80f, 0.65f, 0.35f}};

}  // namespace

Canvas draw_curve(const Curve& curve, int width, int height) {
    Canvas canvas(width, height, kPaper);
    canvas.text(kLeft, 36, curve.title, 17, kInk);
    float x0 = 0.0f, x1 = 1e-6f, y0 = 0.0f, y1 = 1e-6f;
    const auto include = [&](const CurvePoints& points) {
        for (const auto& [x, y] : points) {
            x1 = std::max(x1, x);
            y0 = std::min(y0, y);
            y1 = std::max(y1, y);
        }
    };
    include(curve.points);
    for (const Curve::Line& line : curve.behind) include(line.points);
    const float y_step = float(nice_step(double(y1 - y0))), x_step = float(nice_step(double(x1 - x0)));
    y0 = std::floor(y0 / y_step) * y_step;
    y1 = std::ceil(y1 / y_step) * y_step;
    const auto px = [&](float x) {
        return float(kLeft) + (x - x0) / (x1 - x0) * float(width - kLeft - kRight);
    };
    const auto py = [&](float y) {
        return float(height - kBottom) - (y - y0) / (y1 - y0) * float(height - kTop - kBottom);
    };
    for (int i = 0; y0 + float(i) * y_step <= y1 + 0.01f * y_step; ++i) {
        const float y = y0 + float(i) * y_step;
        canvas.line(px(x0), py(y), px(x1), py(y), 1, kGrid);
        const std::string label = axis_label(double(y));
        canvas.text(kLeft - 10 - Canvas::text_width(label, 11), static_cast<int>(py(y)) + 5, label, 11, kInk);
    }
    for (int i = 0; float(i) * x_step <= x1 * 1.001f; ++i)
        canvas.text(static_cast<int>(px(float(i) * x_step)) - 5, height - kBottom + 22,
                    axis_label(double(float(i) * x_step)), 11, kInk);
    canvas.line(px(x0), py(0), px(x1), py(0), 1, kInk);
    for (const auto& [x, name] : curve.marks) {
        canvas.line(px(x), float(kTop), px(x), float(height - kBottom), 1, kMark);
        canvas.text(static_cast<int>(px(x)) + 6, kTop + 14, name, 11, kMark);
    }
    int legend = width - kRight;
    const auto draw = [&](const CurvePoints& points, const std::string& name, const Color& color) {
        for (size_t i = 1; i < points.size(); ++i)
            canvas.line(px(points[i - 1].first), py(points[i - 1].second), px(points[i].first),
                        py(points[i].second), 2, color);
        if (name.empty()) return;
        legend -= Canvas::text_width(name, 11);
        canvas.text(legend, kTop - 6, name, 11, color);
        legend -= 16;
    };
    for (size_t i = 0; i < curve.behind.size(); ++i)
        draw(curve.behind[i].points, curve.behind[i].name, kBehind[i % std::size(kBehind)]);
    draw(curve.points, curve.name, kLine);
    canvas.text(width - kRight - Canvas::text_width(curve.x_label, 12), height - 20, curve.x_label, 12, kInk);
    canvas.text(kLeft, kTop - 6, curve.y_label, 11, kInk);
    return canvas;
}

}  // namespace vfit::tools
