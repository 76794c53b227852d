#include "cook/pattern/pattern.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "math/finite.h"

namespace vfit {

namespace {

constexpr float kLargestPanel_m = 8.0f, kSmallestArea_m2 = 1e-4f, kShortestEdge_m = 1e-4f;
constexpr float kMostGather = 4.0f;  // longer over shorter of two edges that are sewn together
constexpr uint32_t kFineSteps = 64;  // of a curve: its length to a thousandth

float cross2(const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; }

struct Arc {
    Vec2 center;
    float begin, turn;  // angles, rad
};

/// The circle through both ends of that radius: of the two, and of its two ways round, the one that is asked
/// for.
Arc arc_of(const Vec2& from, const Vec2& to, const PatternEdge& edge) {
    const Vec2 chord = to - from;
    const float length = glm::length(chord);
    const float radius =
        std::max(edge.radius_m, 0.5f * length);  // too small a circle is taken as half a circle
    const float height = std::sqrt(std::max(0.0f, radius * radius - 0.25f * length * length));
    const Vec2 left = Vec2(-chord.y, chord.x) / length;
    // Counter-clockwise the shorter way round, the centre is to the left.
    const float side = edge.turns_left == edge.large_arc ? -1.0f : 1.0f;
    const Vec2 center = 0.5f * (from + to) + left * (side * height);
    const float begin = std::atan2(from.y - center.y, from.x - center.x),
                end = std::atan2(to.y - center.y, to.x - center.x);
    float turn = end - begin;
    if (edge.turns_left && turn <= 0.0f) turn += 2.0f * kPi;
    if (!edge.turns_left && turn >= 0.0f) turn -= 2.0f * kPi;
    return {center, begin, turn};
}

/// Places along the edge at even parameters.
std::vector<Vec2> fine_line(const Panel& panel, const PatternEdge& edge) {
    const Vec2 from = panel.corners[edge.from], to = panel.corners[edge.to];
    if (edge.curve == PatternEdge::Curve::line) return {from, to};
    std::vector<Vec2> line;
    const Arc arc = edge.curve == PatternEdge::Curve::arc ? arc_of(from, to, edge) : Arc{};
    for (uint32_t i = 0; i <= kFineSteps; ++i) {
        const float t = float(i) / float(kFineSteps), s = 1.0f - t;
        switch (edge.curve) {
            case PatternEdge::Curve::quadratic:
                line.push_back(s * s * from + 2.0f * s * t * edge.control[0] + t * t * to);
                break;
            case PatternEdge::Curve::cubic:
                line.push_back(s * s * s * from + 3.0f * s * s * t * edge.control[0] +
                               3.0f * s * t * t * edge.control[1] + t * t * t * to);
                break;
            default: {
                const float angle = arc.begin + t * arc.turn;
                line.push_back(arc.center +
                               glm::length(from - arc.center) * Vec2(std::cos(angle), std::sin(angle)));
            }
        }
    }
    line.front() = from, line.back() = to;
    return line;
}

bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const float s = cross2(b - a, c - a) * cross2(b - a, d - a),
                t = cross2(d - c, a - c) * cross2(d - c, b - c);
    return s < 0.0f && t < 0.0f;
}

void check_edges(const Pattern& pattern, uint32_t p) {
    const Panel& panel = pattern.panels[p];
    if (panel.edges.size() < 3)
        fail(VFIT_ERROR_DATA, "panel ", panel.name, " has ", panel.edges.size(),
             " edges: three make the smallest");
    for (size_t c = 0; c < panel.corners.size(); ++c) {
        if (!finite(panel.corners[c].x) || !finite(panel.corners[c].y))
            fail(VFIT_ERROR_DATA, "panel ", panel.name, ", corner ", c, " is not finite");
        if (glm::length(panel.corners[c] - panel.corners[0]) > kLargestPanel_m)
            fail(VFIT_ERROR_DATA, "panel ", panel.name, ", corner ", c, " is ",
                 glm::length(panel.corners[c] - panel.corners[0]), " m from the first: the largest panel is ",
                 kLargestPanel_m, " m (is the unit right?)");
    }
    if (!finite(panel.translation) || !finite(Vec3(panel.rotation.x, panel.rotation.y, panel.rotation.z)) ||
        !finite(panel.rotation.w))
        fail(VFIT_ERROR_DATA, "panel ", panel.name,
             " is placed nowhere: its translation or rotation is not finite");
    for (uint32_t e = 0; e < panel.edges.size(); ++e) {
        const PatternEdge &edge = panel.edges[e], &next = panel.edges[(e + 1) % panel.edges.size()];
        if (edge.from >= panel.corners.size() || edge.to >= panel.corners.size())
            fail(VFIT_ERROR_DATA, pattern.text({p, e}), " names corner ", std::max(edge.from, edge.to),
                 " of ", panel.corners.size());
        if (edge.to != next.from)
            fail(VFIT_ERROR_DATA, pattern.text({p, e}), " ends at corner ", edge.to,
                 " and the next one begins at ", next.from, ": the edges make no closed line");
        const bool controls =
            edge.curve == PatternEdge::Curve::quadratic || edge.curve == PatternEdge::Curve::cubic;
        if ((controls && (!finite(edge.control[0].x + edge.control[0].y) ||
                          !finite(edge.control[1].x + edge.control[1].y))) ||
            (edge.curve == PatternEdge::Curve::arc && !(finite(edge.radius_m) && edge.radius_m > 0.0f)))
            fail(VFIT_ERROR_DATA, pattern.text({p, e}), ": its curve is not finite");
        if (!(edge_length(panel, edge) >= kShortestEdge_m))
            fail(VFIT_ERROR_DATA, pattern.text({p, e}), " has no length");
    }
}

/// Lines that touch count as apart: a dart of no width is none.
void check_crossings(const Pattern& pattern, uint32_t p) {
    const Panel& panel = pattern.panels[p];
    struct Segment {
        Vec2 a, b;
        uint32_t edge;
    };
    std::vector<Segment> segments;
    float area2 = 0.0f;
    constexpr uint32_t kSteps = 16;  // of a curve
    for (uint32_t e = 0; e < panel.edges.size(); ++e) {
        const bool straight = panel.edges[e].curve == PatternEdge::Curve::line;
        const std::vector<Vec2> line = sample_edge(panel, panel.edges[e], straight ? 1 : kSteps);
        for (size_t i = 0; i + 1 < line.size(); ++i) {
            segments.push_back({line[i], line[i + 1], e});
            area2 += cross2(line[i] - panel.corners[0], line[i + 1] - panel.corners[0]);
        }
    }
    for (size_t i = 0; i < segments.size(); ++i)
        for (size_t k = i + 2; k < segments.size(); ++k)
            if (segments_cross(segments[i].a, segments[i].b, segments[k].a, segments[k].b))
                fail(VFIT_ERROR_DATA, "panel ", panel.name, " crosses itself: edges ", segments[i].edge,
                     " and ", segments[k].edge);
    if (!(std::abs(area2) >= 2.0f * kSmallestArea_m2))
        fail(VFIT_ERROR_DATA, "panel ", panel.name, " has an area of ", 0.5f * std::abs(area2), " m2");
}

void check_stitches(const Pattern& pattern) {
    std::set<std::pair<uint32_t, uint32_t>> sewn;
    for (size_t s = 0; s < pattern.stitches.size(); ++s) {
        const Stitch& stitch = pattern.stitches[s];
        float lengths[2];
        int side = 0;
        for (const EdgeName& name : {stitch.a, stitch.b}) {
            if (name.panel >= pattern.panels.size())
                fail(VFIT_ERROR_DATA, "stitch ", s, " names panel ", name.panel, " of ",
                     pattern.panels.size());
            const Panel& panel = pattern.panels[name.panel];
            if (name.edge >= panel.edges.size())
                fail(VFIT_ERROR_DATA, "stitch ", s, " names edge ", name.edge, " of panel ", panel.name,
                     ", which has ", panel.edges.size());
            lengths[side++] = edge_length(panel, panel.edges[name.edge]);
        }
        if (stitch.a == stitch.b)
            fail(VFIT_ERROR_DATA, "stitch ", s, " sews ", pattern.text(stitch.a), " to itself");
        for (const EdgeName& name : {stitch.a, stitch.b})
            if (!sewn.insert({name.panel, name.edge}).second)
                fail(VFIT_ERROR_DATA, "stitch ", s, " sews ", pattern.text(name), " a second time");
        const float ratio = std::max(lengths[0], lengths[1]) / std::min(lengths[0], lengths[1]);
        if (ratio > kMostGather)
            fail(VFIT_ERROR_DATA, "stitch ", s, " does not pair: ", pattern.text(stitch.a), " is ",
                 lengths[0] * 100.0f, " cm long, ", pattern.text(stitch.b), " ", lengths[1] * 100.0f, " cm");
    }
}

}  // namespace

std::string Pattern::text(const EdgeName& edge) const {
    return "panel " + (edge.panel < panels.size() ? panels[edge.panel].name : std::to_string(edge.panel)) +
           ", edge " + std::to_string(edge.edge);
}

float edge_length(const Panel& panel, const PatternEdge& edge) {
    const std::vector<Vec2> line = fine_line(panel, edge);
    float length = 0.0f;
    for (size_t i = 0; i + 1 < line.size(); ++i) length += glm::length(line[i + 1] - line[i]);
    return length;
}

std::vector<Vec2> sample_edge(const Panel& panel, const PatternEdge& edge, uint32_t count) {
    const std::vector<Vec2> line = fine_line(panel, edge);
    const float step = edge_length(panel, edge) / float(count);
    std::vector<Vec2> out{line.front()};
    size_t i = 0;
    float begin = 0.0f, length = glm::length(line[1] - line[0]);
    for (uint32_t k = 1; k < count; ++k) {
        const float wanted = step * float(k);
        while (begin + length < wanted && i + 2 < line.size()) {
            begin += length;
            ++i;
            length = glm::length(line[i + 1] - line[i]);
        }
        out.push_back(glm::mix(line[i], line[i + 1], length > 0.0f ? (wanted - begin) / length : 0.0f));
    }
    out.push_back(line.back());
    return out;
}

void check_pattern(const Pattern& pattern) {
    if (pattern.panels.empty()) fail(VFIT_ERROR_DATA, "the pattern has no panel");
    for (uint32_t p = 0; p < pattern.panels.size(); ++p) check_edges(pattern, p), check_crossings(pattern, p);
    check_stitches(pattern);
}

}  // namespace vfit
