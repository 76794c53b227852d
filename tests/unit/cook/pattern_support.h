// Patterns made of few numbers, for the tests of the cook.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "cook/pattern/pattern.h"

namespace vfit {

inline std::vector<std::byte> bytes_of_text(const std::string& text) {
    std::vector<std::byte> bytes(text.size());
    if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

/// A panel of straight edges through these corners.
inline Panel straight_panel(const std::string& name, std::vector<Vec2> corners, const Vec3& at = Vec3(0.0f)) {
    Panel panel;
    panel.name = name;
    panel.corners = std::move(corners);
    for (uint32_t i = 0; i < panel.corners.size(); ++i) {
        PatternEdge edge;
        edge.from = i;
        edge.to = (i + 1) % uint32_t(panel.corners.size());
        panel.edges.push_back(edge);
    }
    panel.translation = at;
    return panel;
}

/// A skirt of two rectangles, before and behind the body, that are sewn together at both sides.
inline Pattern tube(float half_width_m, float height_m, float top_m) {
    Pattern pattern;
    pattern.name = "tube";
    const float w = half_width_m, h = height_m;
    pattern.panels.push_back(
        straight_panel("front", {{-w, 0}, {w, 0}, {w, h}, {-w, h}}, {0, top_m - h, 0.3f}));
    pattern.panels.push_back(
        straight_panel("back", {{w, 0}, {-w, 0}, {-w, h}, {w, h}}, {0, top_m - h, -0.3f}));
    pattern.stitches = {{{0, 1}, {1, 3}}, {{0, 3}, {1, 1}}};
    return pattern;
}

}  // namespace vfit
