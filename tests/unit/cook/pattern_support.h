// For the tests of the cook: patterns made of few numbers, and the designs of assets/garments.
#pragma once

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "cook/pattern/pattern.h"

namespace vfit {

inline std::vector<std::byte> bytes_of_text(const std::string& text) {
    std::vector<std::byte> bytes(text.size());
    if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

/// The names of all designs in assets/garments, in order. A new one is tested without a change to the tests.
inline std::vector<std::string> shipped_designs() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(VFIT_SOURCE_DIR "/assets/garments"))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

inline std::string design_path(const std::string& name) {
    return VFIT_SOURCE_DIR "/assets/garments/" + name + ".json";
}

inline std::string design_text(const std::string& name) {
    std::ifstream stream(design_path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
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
