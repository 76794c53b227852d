// Panels as meshes, and what seams make of them.
#include "cook/sew/sewn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "core/error.h"
#include "pattern_support.h"

namespace vfit {
namespace {

float area2(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

float smallest_angle(const Vec2& a, const Vec2& b, const Vec2& c) {
    const auto angle = [](const Vec2& at, const Vec2& p, const Vec2& q) {
        return std::acos(std::clamp(glm::dot(glm::normalize(p - at), glm::normalize(q - at)), -1.0f, 1.0f));
    };
    return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)}) * 180.0f / kPi;
}

TEST(Triangulation, FillsOutlinesOfAnyShape) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> radius(0.1f, 0.5f);
    for (int round = 0; round < 200; ++round) {
        const uint32_t count = 3 + uint32_t(random() % 60);
        std::vector<Vec2> points;
        float wanted = 0.0f;
        for (uint32_t i = 0; i < count; ++i) {
            const float angle = 2.0f * kPi * float(i) / float(count), r = radius(random);
            points.emplace_back(r * std::cos(angle), r * std::sin(angle));
        }
        for (uint32_t i = 0; i < count; ++i) wanted += area2({0, 0}, points[i], points[(i + 1) % count]);
        if (round % 2) std::reverse(points.begin(), points.end());
        const Triangles triangles = triangulate(points, count);
        EXPECT_EQ(triangles.size(), count - 2);
        float sum = 0.0f;
        for (const auto& t : triangles) {
            EXPECT_GT(area2(points[t[0]], points[t[1]], points[t[2]]), 0.0f);
            sum += area2(points[t[0]], points[t[1]], points[t[2]]);
        }
        EXPECT_NEAR(sum, wanted, 1e-4f);
    }
}

TEST(Triangulation, NamesPointsThatMeet) {
    const std::vector<Vec2> twice{{0, 0}, {1, 0}, {1, 1}, {1, 0}, {0, 1}};
    EXPECT_THROW(triangulate(twice, 5), Error);
}

TEST(PanelMesh, IsNearRegular) {
    Panel panel = straight_panel("p", {{0, 0}, {0.5f, 0}, {0.55f, 0.3f}, {0.3f, 0.7f}, {0, 0.6f}});
    panel.edges[2].curve = PatternEdge::Curve::quadratic;
    panel.edges[2].control[0] = {0.35f, 0.4f};
    const PanelMesh mesh = mesh_panel(panel, {25, 15, 24, 16, 30}, 0.02f);
    std::vector<float> angles, sides;
    for (const auto& t : mesh.triangles) {
        angles.push_back(smallest_angle(mesh.flat[t[0]], mesh.flat[t[1]], mesh.flat[t[2]]));
        for (int k = 0; k < 3; ++k)
            sides.push_back(glm::length(mesh.flat[t[size_t(k)]] - mesh.flat[t[size_t(k + 1) % 3]]));
        EXPECT_GT(area2(mesh.flat[t[0]], mesh.flat[t[1]], mesh.flat[t[2]]), 0.0f);
    }
    std::sort(angles.begin(), angles.end());
    std::sort(sides.begin(), sides.end());
    EXPECT_GT(angles.front(), 18.0f);
    EXPECT_GT(angles[angles.size() / 2], 48.0f);  // 60 where all are equal
    EXPECT_GT(sides.front(), 0.009f);
    EXPECT_LT(sides.back(), 0.032f);
}

TEST(PanelMesh, GoesToAnotherSizeAndBack) {
    const Panel small = straight_panel("p", {{0, 0}, {0.4f, 0}, {0.4f, 0.6f}, {0, 0.6f}});
    const Panel large = straight_panel("p", {{0, 0}, {0.5f, 0}, {0.46f, 0.65f}, {-0.02f, 0.6f}});
    const PanelMesh mesh = mesh_panel(small, {20, 30, 20, 30}, 0.02f);
    const std::vector<Vec2> same = carry_to_size(mesh, small), graded = carry_to_size(mesh, large);
    for (size_t i = 0; i < same.size(); ++i) EXPECT_LT(glm::length(same[i] - mesh.flat[i]), 1e-5f);
    float area = 0.0f;
    for (const auto& t : mesh.triangles) {
        EXPECT_GT(area2(graded[t[0]], graded[t[1]], graded[t[2]]), 0.0f);
        area += 0.5f * area2(graded[t[0]], graded[t[1]], graded[t[2]]);
    }
    float wanted = 0.0f;
    for (size_t i = 0; i < 4; ++i)
        wanted += 0.5f * area2({0, 0}, large.corners[i], large.corners[(i + 1) % 4]);
    EXPECT_NEAR(area, wanted, 1e-4f);
}

/// How many boundary loops, and does each inner side have its two triangles in opposite directions?
size_t border_loops(const SewnMesh& mesh) {
    std::map<std::pair<uint32_t, uint32_t>, int> sides;
    for (size_t i = 0; i < mesh.sewn_indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k)
            EXPECT_EQ(++sides[std::pair(mesh.sewn_indices[i + k], mesh.sewn_indices[i + (k + 1) % 3])], 1);
    std::map<uint32_t, uint32_t> next;
    for (const auto& [side, count] : sides)
        if (!sides.count({side.second, side.first})) next[side.first] = side.second;
    size_t loops = 0;
    while (!next.empty()) {
        uint32_t v = next.begin()->first;
        while (next.count(v)) {
            const uint32_t to = next[v];
            next.erase(v);
            v = to;
        }
        ++loops;
    }
    return loops;
}

TEST(Sewn, MakesATubeOfTwoPanels) {
    const SewnMesh mesh = sew(tube(0.3f, 0.4f, 1.0f), 0.03f);
    EXPECT_EQ(border_loops(mesh), 2u);
    EXPECT_LT(mesh.sewn_count, mesh.panel_vertex_count());
    EXPECT_EQ(mesh.panel_vertex_count() - mesh.sewn_count, 2u * 14u);  // 13 sides of 3 cm along each seam
}

TEST(Sewn, ClosesADartOfOnePanel) {
    Pattern pattern;
    pattern.panels.push_back(straight_panel(
        "p", {{0, 0}, {0.18f, 0}, {0.2f, 0.15f}, {0.22f, 0}, {0.4f, 0}, {0.4f, 0.4f}, {0, 0.4f}}));
    pattern.stitches = {{{0, 1}, {0, 2}}};
    const SewnMesh mesh = sew(pattern, 0.02f);
    EXPECT_EQ(border_loops(mesh), 1u);
}

TEST(Sewn, ShortEdgesBecomeOneCorner) {
    Pattern pattern = tube(0.3f, 0.4f, 1.0f);
    for (Panel& panel : pattern.panels) {  // a corner cut off by 2 mm
        const float side = panel.corners[2].x > 0.0f ? 1.0f : -1.0f;
        panel.corners[2] = {side * 0.298f, 0.4f};
        panel.corners.push_back({side * 0.3f, 0.398f});
        panel.edges[1].to = 4;
        PatternEdge cut;
        cut.from = 4, cut.to = 2;
        panel.edges.insert(panel.edges.begin() + 2, cut);
    }
    pattern.stitches = {{{0, 1}, {1, 4}}, {{0, 4}, {1, 1}}};
    EXPECT_EQ(border_loops(sew(pattern, 0.03f)), 2u);
}

TEST(Sewn, TurnsAPanelThatShowsItsInside) {
    Pattern pattern = tube(0.3f, 0.4f, 1.0f);
    std::reverse(pattern.panels[1].corners.begin(), pattern.panels[1].corners.end());
    // Mirrored corners: edge 0 is now at the other end of the panel's outline, and both seams run begin to
    // begin.
    pattern.stitches = {{{0, 1}, {1, 3}, true}, {{0, 3}, {1, 1}, true}};
    EXPECT_EQ(border_loops(sew(pattern, 0.03f)), 2u);
    pattern.stitches[1].turned = false;
    try {
        sew(pattern, 0.03f);
        FAIL() << "a tube with a half turn has no outside";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("stitch 1"), std::string::npos) << error.what();
    }
}

TEST(Sewn, SeamsWithACommonSideGetAVertexBetween) {
    // Two triangles sewn together at two edges: a bag whose corner both cut off with the same side.
    Pattern pattern;
    pattern.panels.push_back(straight_panel("a", {{0, 0}, {0.06f, 0}, {0.03f, 0.05f}}));
    pattern.panels.push_back(straight_panel("b", {{0.06f, 0}, {0, 0}, {0.03f, 0.05f}}));
    pattern.stitches = {{{0, 1}, {1, 2}}, {{0, 2}, {1, 1}}};
    EXPECT_EQ(border_loops(sew(pattern, 0.03f)), 1u);
}

}  // namespace
}  // namespace vfit
