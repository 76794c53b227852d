// Stand-in until the tree's own: lengths and places along the edges of a pattern.
#include "cook/pattern/pattern.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vfit {

namespace {

Vec2 place_on(const Panel& panel, const PatternEdge& edge, float t) {
    const Vec2 a = panel.corners[edge.from], b = panel.corners[edge.to];
    const float s = 1.0f - t;
    switch (edge.curve) {
        case PatternEdge::Curve::line: return glm::mix(a, b, t);
        case PatternEdge::Curve::quadratic: return s * s * a + 2.0f * s * t * edge.control[0] + t * t * b;
        case PatternEdge::Curve::cubic:
            return s * s * s * a + 3.0f * s * s * t * edge.control[0] + 3.0f * s * t * t * edge.control[1] + t * t * t * b;
        case PatternEdge::Curve::arc: break;
    }
    const Vec2 chord = b - a;
    const float half = 0.5f * glm::length(chord), radius = std::max(edge.radius_m, half);
    const Vec2 left = Vec2(-chord.y, chord.x) / (2.0f * half);
    // A short arc that turns left has its centre on its left, a large one on its right.
    const float side = edge.turns_left != edge.large_arc ? 1.0f : -1.0f;
    const Vec2 centre = 0.5f * (a + b) + side * std::sqrt(radius * radius - half * half) * left;
    float angle = 2.0f * std::asin(std::min(1.0f, half / radius));
    if (edge.large_arc) angle = 2.0f * kPi - angle;
    const float turned = (edge.turns_left ? angle : -angle) * t;
    const Vec2 r = a - centre;
    return centre + Vec2(std::cos(turned) * r.x - std::sin(turned) * r.y, std::sin(turned) * r.x + std::cos(turned) * r.y);
}

std::vector<Vec2> fine(const Panel& panel, const PatternEdge& edge) {
    const int steps = edge.curve == PatternEdge::Curve::line ? 1 : 256;
    std::vector<Vec2> out;
    for (int i = 0; i <= steps; ++i) out.push_back(place_on(panel, edge, float(i) / float(steps)));
    return out;
}

}  // namespace

std::string Pattern::text(const EdgeName& edge) const {
    return vfit::text("panel ", edge.panel < panels.size() ? panels[edge.panel].name : "?", ", edge ", edge.edge);
}

float edge_length(const Panel& panel, const PatternEdge& edge) {
    const std::vector<Vec2> line = fine(panel, edge);
    double length = 0.0;
    for (size_t i = 0; i + 1 < line.size(); ++i) length += double(glm::distance(line[i], line[i + 1]));
    return float(length);
}

std::vector<Vec2> sample_edge(const Panel& panel, const PatternEdge& edge, uint32_t count) {
    const std::vector<Vec2> line = fine(panel, edge);
    const float step = edge_length(panel, edge) / float(count);
    std::vector<Vec2> out{line.front()};
    float begin = 0.0f;
    size_t i = 0;
    for (uint32_t k = 1; k < count; ++k) {
        const float wanted = step * float(k);
        float length = glm::distance(line[i], line[i + 1]);
        while (begin + length < wanted && i + 2 < line.size()) {
            begin += length;
            ++i;
            length = glm::distance(line[i], line[i + 1]);
        }
        out.push_back(glm::mix(line[i], line[i + 1], length > 0.0f ? (wanted - begin) / length : 0.0f));
    }
    out.push_back(line.back());
    return out;
}

}  // namespace vfit
