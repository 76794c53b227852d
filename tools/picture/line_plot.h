// One quantity over time as a line.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "picture/canvas.h"

namespace vfit::tools {

struct Curve {
    std::string title, x_label, y_label;
    std::vector<std::pair<float, float>> points;  // x ascending
};

Canvas draw_curve(const Curve& curve, int width, int height);

}  // namespace vfit::tools
