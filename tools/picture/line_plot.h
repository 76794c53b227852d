// One quantity over time as a line, or several beside each other.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "picture/canvas.h"

namespace vfit::tools {

using CurvePoints = std::vector<std::pair<float, float>>;  // x ascending

struct Curve {
    std::string title, x_label, y_label;
    CurvePoints points{};
    std::string name{};  // empty: the line needs none
    struct Line {
        std::string name;
        CurvePoints points;
    };
    std::vector<Line> behind{};  // further lines, drawn first
    std::vector<std::pair<float, std::string>>
        marks{};  // places of x with a name, such as where a phase begins
};

Canvas draw_curve(const Curve& curve, int width, int height);

}  // namespace vfit::tools
