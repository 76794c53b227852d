// Sewing patterns: curves, checks, and GarmentCode specifications whole, damaged and in the wrong unit.
#include "cook/pattern/pattern.h"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "cook/pattern/garmentcode.h"
#include "core/error.h"
#include "pattern_support.h"

namespace vfit {
namespace {

using OrderedJson = nlohmann::json;

std::string fault_of(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
        return error.what();
    }
    return "";
}

/// Two squares of 40 cm, sewn together at one edge.
OrderedJson specification() {
    const auto panel = [](float z) {
        OrderedJson edges = OrderedJson::array();
        for (int i = 0; i < 4; ++i) edges.push_back({{"endpoints", {i, (i + 1) % 4}}});
        return OrderedJson{{"translation", {0, 100, z}},
                           {"rotation", {0, 0, 0}},
                           {"vertices", {{0, 0}, {40, 0}, {40, 40}, {0, 40}}},
                           {"edges", edges}};
    };
    OrderedJson root;
    root["pattern"]["panels"] = {{"a", panel(30)}, {"b", panel(-30)}};
    root["pattern"]["stitches"] = {{{{"panel", "a"}, {"edge", 1}}, {{"panel", "b"}, {"edge", 3}}}};
    root["properties"] = {{"curvature_coords", "relative"}, {"units_in_meter", 100}};
    return root;
}

std::string fault_with(const std::function<void(OrderedJson&)>& change) {
    OrderedJson root = specification();
    change(root);
    return fault_of([&] { parse_garmentcode(bytes_of_text(root.dump()), "test"); });
}

void expect_names(const std::string& fault, const std::string& what) {
    EXPECT_NE(fault.find(what), std::string::npos) << "\"" << fault << "\" does not name \"" << what << "\"";
}

TEST(Pattern, SamplesCurvesAtEvenLengths) {
    Panel panel = straight_panel("p", {{0, 0}, {0.4f, 0}, {0.2f, 0.3f}});
    PatternEdge& edge = panel.edges[0];
    for (const auto curve : {PatternEdge::Curve::line, PatternEdge::Curve::quadratic,
                             PatternEdge::Curve::cubic, PatternEdge::Curve::arc}) {
        edge.curve = curve;
        edge.control[0] = {0.05f, -0.2f};
        edge.control[1] = {0.1f, -0.1f};
        edge.radius_m = 0.25f;
        const std::vector<Vec2> places = sample_edge(panel, edge, 10);
        ASSERT_EQ(places.size(), 11u);
        EXPECT_EQ(places.front(), panel.corners[0]);
        EXPECT_EQ(places.back(), panel.corners[1]);
        for (size_t i = 1; i < places.size(); ++i)
            EXPECT_NEAR(glm::length(places[i] - places[i - 1]), edge_length(panel, edge) / 10.0f, 0.002f)
                << int(curve);  // chords of a curve
    }
}

TEST(Pattern, DrawsTheFourArcsOfACircle) {
    Panel panel = straight_panel("p", {{0, 0}, {0.2f, 0}, {0.1f, 0.5f}});
    PatternEdge& edge = panel.edges[0];
    edge.curve = PatternEdge::Curve::arc;
    edge.radius_m = 0.125f;  // its centres are 0.075 off the chord
    for (const bool large : {false, true})
        for (const bool left : {false, true}) {
            edge.large_arc = large, edge.turns_left = left;
            const Vec2 middle = sample_edge(panel, edge, 2)[1];
            // Counter-clockwise from left to right goes below.
            const float off = large ? 0.2f : 0.05f;
            EXPECT_NEAR(middle.x, 0.1f, 1e-4f);
            EXPECT_NEAR(middle.y, left ? -off : off, 1e-4f) << large << left;
        }
}

TEST(GarmentCode, ReadsPanelsInMetres) {
    const Pattern pattern = parse_garmentcode(bytes_of_text(specification().dump()), "test");
    ASSERT_EQ(pattern.panels.size(), 2u);
    EXPECT_FLOAT_EQ(pattern.panels[0].corners[2].x, 0.4f);
    EXPECT_FLOAT_EQ(pattern.panels[0].translation.z, 0.3f);
    ASSERT_EQ(pattern.stitches.size(), 1u);
    EXPECT_EQ(pattern.stitches[0].b.edge, 3u);
    EXPECT_FALSE(pattern.stitches[0].turned);
}

TEST(GarmentCode, TurnsPanelsAboutXThenYThenZ) {
    OrderedJson root = specification();
    root["pattern"]["panels"]["a"]["rotation"] = {90, 0, 90};
    const Pattern pattern = parse_garmentcode(bytes_of_text(root.dump()), "test");
    const Vec3 up = pattern.panels[0].rotation * Vec3(0, 1, 0);  // y to z about x, and there it stays about z
    EXPECT_NEAR(glm::length(up - Vec3(0, 0, 1)), 0.0f, 1e-5f);
}

TEST(GarmentCode, NamesWhatIsWrong) {
    const auto panel = [](OrderedJson& root) -> OrderedJson& { return root["pattern"]["panels"]["a"]; };
    expect_names(fault_with([&](OrderedJson& r) { panel(r)["edges"][2]["endpoints"] = {2, 9}; }),
                 "panel a, edge 2");
    expect_names(fault_with([&](OrderedJson& r) { panel(r)["edges"][1]["endpoints"] = {1, 3}; }),
                 "no closed line");
    expect_names(fault_with([&](OrderedJson& r) {
                     panel(r)["edges"][1]["curvature"] = {{"type", "spline"}, {"params", {{0.5, 0.1}}}};
                 }),
                 "spline");
    expect_names(
        fault_with([&](OrderedJson& r) { panel(r)["vertices"] = {{0, 0}, {40, 40}, {40, 0}, {0, 40}}; }),
        "panel a crosses itself: edges 0 and 2");
    expect_names(fault_with([&](OrderedJson& r) { panel(r)["vertices"][1] = {"wide", 0}; }),
                 "panel a, vertex 1");
    expect_names(
        fault_with([&](OrderedJson& r) { panel(r)["vertices"] = {{0, 0}, {40, 0}, {20, 0}, {10, 0}}; }),
        "panel a has an area");
    expect_names(fault_with([&](OrderedJson& r) { r["pattern"]["stitches"][0][1]["panel"] = "c"; }),
                 "stitch 0 names a panel \"c\"");
    expect_names(fault_with([&](OrderedJson& r) { r["pattern"]["stitches"][0][1]["edge"] = 7; }), "stitch 0");
    expect_names(fault_with([&](OrderedJson& r) { r["pattern"]["stitches"][0].erase(1); }),
                 "stitch 0 does not pair");
    expect_names(
        fault_with([&](OrderedJson& r) { r["pattern"]["stitches"].push_back(r["pattern"]["stitches"][0]); }),
        "a second time");
    expect_names(
        fault_with([&](OrderedJson& r) { r["pattern"]["stitches"][0][1] = r["pattern"]["stitches"][0][0]; }),
        "to itself");
    expect_names(fault_with([&](OrderedJson& r) {
                     r["pattern"]["panels"]["b"]["vertices"] = {{0, 0}, {40, 0}, {40, 5}, {0, 5}};
                 }),
                 "stitch 0 does not pair");
    expect_names(fault_with([&](OrderedJson& r) { r["pattern"]["panels"] = OrderedJson::object(); }),
                 "no panels");
    expect_names(fault_with([&](OrderedJson& r) { r["pattern"].erase("panels"); }), "panels");
    expect_names(fault_with([&](OrderedJson& r) { r["properties"]["units_in_meter"] = 0; }),
                 "units_in_meter");
    expect_names(fault_with([&](OrderedJson& r) { r["properties"]["curvature_coords"] = "polar"; }),
                 "curvature_coords");
}

TEST(GarmentCode, SaysWhichUnitTheNumbersLookLike) {
    const auto scale = [](OrderedJson& root, float by) {
        for (auto& [name, panel] : root["pattern"]["panels"].items())
            for (auto& v : panel["vertices"])
                for (auto& x : v) x = x.get<float>() * by;
    };
    expect_names(fault_with([&](OrderedJson& r) { scale(r, 0.01f); }), "metres: units_in_meter 1");
    expect_names(fault_with([&](OrderedJson& r) { scale(r, 10.0f); }), "millimetres: units_in_meter 1000");
    OrderedJson in_metres = specification();
    scale(in_metres, 0.01f);
    in_metres["properties"]["units_in_meter"] = 1;
    EXPECT_NO_THROW(parse_garmentcode(bytes_of_text(in_metres.dump()), "test"));
}

TEST(GarmentCode, RefusesTextThatIsCutAnywhere) {
    const std::string text = specification().dump();
    for (size_t length = 0; length < text.size(); length += 7)
        EXPECT_NE(fault_of([&] { parse_garmentcode(bytes_of_text(text.substr(0, length)), "test"); }), "")
            << length;
}

}  // namespace
}  // namespace vfit
