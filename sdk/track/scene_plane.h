// A plane of the scene as a depth image shows it: 1 / z is linear in the image.
#pragma once

#include <algorithm>

namespace vfit {

/// Least squares over cells; sums are taken around the first cell.
class ScenePlane {
public:
    void add(float column, float row, float z) {
        if (count_ == 0.0) first_ = {column, row, 1.0 / double(z)};
        const double x = column - first_.x, y = row - first_.y, w = 1.0 / double(z) - first_.w;
        count_ += 1.0, sum_.x += x, sum_.y += y, sum_.w += w;
        xx_ += x * x, xy_ += x * y, yy_ += y * y, xw_ += x * w, yw_ += y * w;
    }
    /// False where the cells lie on a line and so on many planes.
    bool fit() {
        if (count_ < 3.0) return false;
        middle_ = {sum_.x / count_, sum_.y / count_, sum_.w / count_};
        const double xx = xx_ / count_ - middle_.x * middle_.x, yy = yy_ / count_ - middle_.y * middle_.y,
                     xy = xy_ / count_ - middle_.x * middle_.y, xw = xw_ / count_ - middle_.x * middle_.w,
                     yw = yw_ / count_ - middle_.y * middle_.w;
        const double determinant = xx * yy - xy * xy;
        if (determinant < kThin * (xx + yy)) return false;
        across_ = (xw * yy - yw * xy) / determinant;
        down_ = (yw * xx - xw * xy) / determinant;
        return true;
    }
    /// Of the fitted plane; 1 km where a cell looks past it.
    float depth(float column, float row) const {
        const double w = first_.w + middle_.w + across_ * (column - first_.x - middle_.x) +
                         down_ * (row - first_.y - middle_.y);
        return float(1.0 / std::max(w, 1e-3));
    }

private:
    struct Cell {
        double x = 0.0, y = 0.0, w = 0.0;  // column, row, 1 / z
    };
    static constexpr double kThin = 0.1;  // cells squared: less than a strip of one cell has across
    Cell first_, sum_, middle_;
    double count_ = 0.0, xx_ = 0.0, xy_ = 0.0, yy_ = 0.0, xw_ = 0.0, yw_ = 0.0;
    double across_ = 0.0, down_ = 0.0;
};

}  // namespace vfit
