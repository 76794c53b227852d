// Where a plot's axis has its marks, and how they are written.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace vfit::tools {

/// The step of 1, 2 or 5 times a power of ten that cuts the range in about five.
inline double nice_step(double range) {
    const double raw = range / 5.0, power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double f : {1.0, 2.0, 5.0})
        if (raw <= f * power) return f * power;
    return 10.0 * power;
}

inline std::string axis_label(double x) {
    char text[24];
    std::snprintf(text, sizeof text, "%g", std::round(x * 1e4) / 1e4);
    return text;
}

}  // namespace vfit::tools
