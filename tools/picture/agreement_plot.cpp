#include "picture/agreement_plot.h"

#include <algorithm>
#include <cmath>

#include "picture/axis.h"

namespace vfit::tools {

namespace {

constexpr int kWidth = 520, kHeight = 340, kLeft = 70, kRight = 24, kTop = 52, kBottom = 48;  // of a panel
constexpr Color kPaper{1, 1, 1}, kInk{0.16f, 0.17f, 0.20f}, kGrid{0.88f, 0.88f, 0.90f},
    kDot{0.20f, 0.42f, 0.66f}, kMean{0.80f, 0.27f, 0.30f}, kLimits{0.50f, 0.52f, 0.56f},
    kBand{0.91f, 0.96f, 0.90f};

/// One measure, its upper left corner at (left, top).
class Panel {
public:
    Panel(Canvas& canvas, int left, int top, const AgreementPanel& panel)
        : canvas_(canvas), left_(left), top_(top), panel_(panel), agreement_(agreement(panel.list)) {
        x0_ = 1e9, x1_ = -1e9;
        double reach =
            1.2 * std::max({std::abs(agreement_.low), std::abs(agreement_.high), panel.limit_m, 1e-3});
        for (const Compared& c : panel.list) {
            const double middle = 0.5 * (c.scanned + c.taped);
            x0_ = std::min(x0_, middle), x1_ = std::max(x1_, middle);
            reach = std::max(reach, 1.1 * std::abs(c.error()));
        }
        const double margin = std::max(0.02, 0.06 * (x1_ - x0_));
        x0_ -= margin, x1_ += margin;
        y1_ = reach, y0_ = -reach;
    }

    void draw() const {
        if (panel_.limit_m > 0.0)
            canvas_.fill_rect(px(x0_), py(panel_.limit_m), px(x1_) - px(x0_),
                              py(-panel_.limit_m) - py(panel_.limit_m), kBand);
        const double y_unit = panel_.mass ? 1.0 : 1000.0, x_unit = panel_.mass ? 1.0 : 100.0;
        const double y_step = nice_step(y_unit * (y1_ - y0_)) / y_unit;
        for (double y = std::ceil(y0_ / y_step) * y_step; y <= y1_; y += y_step) {
            level(y, 1, kGrid);
            const std::string label = axis_label(y_unit * y);
            canvas_.text(px(x0_) - 8 - Canvas::text_width(label, 9), py(y) + 4, label, 9, kInk);
        }
        const double x_step = nice_step(x_unit * (x1_ - x0_)) / x_unit;
        for (double x = std::ceil(x0_ / x_step) * x_step; x <= x1_; x += x_step) {
            const std::string label = axis_label(x_unit * x);
            canvas_.text(px(x) - Canvas::text_width(label, 9) / 2, top_ + kHeight - kBottom + 16, label, 9,
                         kInk);
        }
        level(0.0, 1, kInk);
        dashed(agreement_.low, kLimits);
        dashed(agreement_.high, kLimits);
        level(agreement_.bias, 2, kMean);
        for (const Compared& c : panel_.list)
            canvas_.disc(float(px(0.5 * (c.scanned + c.taped))), float(py(c.error())), 3.0f, kDot);
        if (std::isfinite(agreement_.confidence))
            canvas_.line(float(px(x1_) - 6), float(py(agreement_.bias - agreement_.confidence)),
                         float(px(x1_) - 6), float(py(agreement_.bias + agreement_.confidence)), 2, kMean);
        canvas_.text(left_ + kLeft, top_ + 22, panel_.title, 12, kInk);
        canvas_.text(
            left_ + kLeft, top_ + 40,
            panel_.mass ? "scan - tape, kg, over their mean" : "scan - tape, mm, over their mean, cm", 9,
            kLimits);
    }

private:
    int px(double x) const {
        return left_ + kLeft + int(std::lround((x - x0_) / (x1_ - x0_) * (kWidth - kLeft - kRight)));
    }
    int py(double y) const {
        return top_ + kHeight - kBottom -
               int(std::lround((y - y0_) / (y1_ - y0_) * (kHeight - kTop - kBottom)));
    }
    void level(double y, int thickness, const Color& color) const {
        canvas_.line(float(px(x0_)), float(py(y)), float(px(x1_)), float(py(y)), thickness, color);
    }
    void dashed(double y, const Color& color) const {
        for (int x = px(x0_); x < px(x1_); x += 14)
            canvas_.line(float(x), float(py(y)), float(std::min(x + 8, px(x1_))), float(py(y)), 1, color);
    }

    Canvas& canvas_;
    int left_, top_;
    const AgreementPanel& panel_;
    Agreement agreement_;
    double x0_, x1_, y0_, y1_;
};

}  // namespace

Canvas draw_agreement(const std::vector<AgreementPanel>& panels) {
    const int columns = panels.size() > 1 ? 2 : 1, rows = (int(panels.size()) + columns - 1) / columns;
    Canvas canvas(columns * kWidth, rows * kHeight, kPaper);
    for (size_t i = 0; i < panels.size(); ++i)
        Panel(canvas, int(i) % columns * kWidth, int(i) / columns * kHeight, panels[i]).draw();
    return canvas;
}

}  // namespace vfit::tools
