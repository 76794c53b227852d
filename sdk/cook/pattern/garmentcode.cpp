#include "cook/pattern/garmentcode.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

constexpr size_t kMostPanels = 1000, kMostEdges = 1000;  // of a pattern, of a panel

float number(const Json& value, const std::string& what) {
    if (!value.is_number()) fail(VFIT_ERROR_DATA, "pattern: ", what, " is not a number");
    return value.get<float>();
}

std::vector<float> numbers(const Json& value, size_t count, const std::string& what) {
    if (!value.is_array() || value.size() != count)
        fail(VFIT_ERROR_DATA, "pattern: ", what, " is no list of ", count, " numbers");
    std::vector<float> out;
    for (const Json& v : value) out.push_back(number(v, what));
    return out;
}

const Json& field(const Json& object, const char* key, std::string_view what) {
    const auto it = object.is_object() ? object.find(key) : object.end();
    if (!object.is_object() || it == object.end())
        fail(VFIT_ERROR_DATA, "pattern: ", what, " has no \"", key, "\"");
    return *it;
}

uint32_t index(const Json& value, size_t count, const std::string& what) {
    if (!value.is_number_unsigned() || value.get<uint64_t>() >= count)
        fail(VFIT_ERROR_DATA, "pattern: ", what, " is no index below ", count);
    return value.get<uint32_t>();
}

class SpecificationReader {
public:
    SpecificationReader(const Json& root, const std::string& name) : root_(root) { pattern_.name = name; }

    Pattern read() {
        const Json& pattern = field(root_, "pattern", "the file");
        read_properties();
        read_panels(field(pattern, "panels", "the pattern"));
        if (pattern.contains("stitches")) read_stitches(pattern["stitches"]);
        check_unit();
        check_pattern(pattern_);
        return std::move(pattern_);
    }

private:
    void read_properties() {
        const Json properties = root_.contains("properties") ? root_["properties"] : Json::object();
        if (!properties.is_object()) fail(VFIT_ERROR_DATA, "pattern: \"properties\" is not an object");
        if (properties.contains("units_in_meter"))
            units_in_meter_ = number(properties["units_in_meter"], "units_in_meter");
        if (!(units_in_meter_ > 0.0f) || !std::isfinite(units_in_meter_))
            fail(VFIT_ERROR_DATA, "pattern: units_in_meter is ", units_in_meter_);
        if (!properties.contains("curvature_coords")) return;
        const Json& kind = properties["curvature_coords"];
        if (kind != "relative" && kind != "absolute")
            fail(VFIT_ERROR_DATA, "pattern: curvature_coords is neither \"relative\" nor \"absolute\"");
        relative_ = kind == "relative";
    }

    void read_panels(const Json& panels) {
        if (!panels.is_object() || panels.empty()) fail(VFIT_ERROR_DATA, "pattern: there are no panels");
        if (panels.size() > kMostPanels)
            fail(VFIT_ERROR_DATA, "pattern: ", panels.size(), " panels, at most ", kMostPanels, " are read");
        for (const auto& [name, json] : panels.items()) {
            panel_of_[name] = uint32_t(pattern_.panels.size());
            pattern_.panels.push_back(read_panel(name, json));
        }
    }

    Panel read_panel(const std::string& name, const Json& json) {
        const std::string what = "panel " + name;
        Panel panel;
        panel.name = name;
        const Json &vertices = field(json, "vertices", what), &edges = field(json, "edges", what);
        if (!vertices.is_array() || !edges.is_array() || vertices.size() > kMostEdges ||
            edges.size() > kMostEdges)
            fail(VFIT_ERROR_DATA, "pattern: ", what, ": \"vertices\" and \"edges\" are no lists of at most ",
                 kMostEdges);
        for (const Json& v : vertices) {
            const std::vector<float> p =
                numbers(v, 2, what + ", vertex " + std::to_string(panel.corners.size()));
            panel.corners.push_back(Vec2(p[0], p[1]) / units_in_meter_);
        }
        for (const Json& e : edges)
            panel.edges.push_back(read_edge(panel, e, what + ", edge " + std::to_string(panel.edges.size())));
        if (json.contains("translation")) {
            const std::vector<float> t = numbers(json["translation"], 3, what + ", translation");
            panel.translation = Vec3(t[0], t[1], t[2]) / units_in_meter_;
        }
        if (json.contains("rotation")) {
            const std::vector<float> r = numbers(json["rotation"], 3, what + ", rotation");
            const auto turn = [](float degrees, const Vec3& axis) {
                return glm::angleAxis(degrees * kPi / 180.0f, axis);
            };
            panel.rotation = turn(r[2], {0, 0, 1}) * turn(r[1], {0, 1, 0}) * turn(r[0], {1, 0, 0});
        }
        return panel;
    }

    PatternEdge read_edge(const Panel& panel, const Json& json, const std::string& what) {
        PatternEdge edge;
        const Json& ends = field(json, "endpoints", what);
        if (!ends.is_array() || ends.size() != 2)
            fail(VFIT_ERROR_DATA, "pattern: ", what, ": \"endpoints\" are no two indices");
        edge.from = index(ends[0], panel.corners.size(), what + ", its begin,");
        edge.to = index(ends[1], panel.corners.size(), what + ", its end,");
        if (json.contains("label") && json["label"].is_string())
            edge.label = json["label"].get<std::string>();
        if (!json.contains("curvature")) return edge;
        const Json& curve = json["curvature"];
        if (curve.is_array()) {  // of older files: the control point of a quadratic one
            edge.curve = PatternEdge::Curve::quadratic;
            edge.control[0] = control(panel, edge, curve, what);
            return edge;
        }
        const Json &type = field(curve, "type", what + ", curvature,"),
                   &params = field(curve, "params", what + ", curvature,");
        const auto points = [&](size_t count) {
            if (!params.is_array() || params.size() != count)
                fail(VFIT_ERROR_DATA, "pattern: ", what, ": its curve has not ", count, " control points");
            for (size_t i = 0; i < count; ++i) edge.control[i] = control(panel, edge, params[i], what);
        };
        if (type == "quadratic") {
            edge.curve = PatternEdge::Curve::quadratic;
            points(1);
        } else if (type == "cubic") {
            edge.curve = PatternEdge::Curve::cubic;
            points(2);
        } else if (type == "circle") {
            edge.curve = PatternEdge::Curve::arc;
            const std::vector<float> p = numbers(params, 3, what + ", its circle,");
            edge.radius_m = p[0] / units_in_meter_;
            edge.large_arc = p[1] != 0.0f;
            edge.turns_left = p[2] != 0.0f;
        } else {
            fail(VFIT_ERROR_DATA, "pattern: ", what, ": a curve of type ", type.dump(),
                 " is not known; quadratic, cubic and circle are");
        }
        return edge;
    }

    /// Relative ones are told along the edge and to its left, in lengths of it.
    Vec2 control(const Panel& panel, const PatternEdge& edge, const Json& json,
                 const std::string& what) const {
        const std::vector<float> p = numbers(json, 2, what + ", control point");
        if (!relative_) return Vec2(p[0], p[1]) / units_in_meter_;
        const Vec2 from = panel.corners[edge.from], along = panel.corners[edge.to] - from;
        return from + p[0] * along + p[1] * Vec2(-along.y, along.x);
    }

    void read_stitches(const Json& stitches) {
        if (!stitches.is_array()) fail(VFIT_ERROR_DATA, "pattern: \"stitches\" is not a list");
        for (const Json& json : stitches) {
            const std::string what = "stitch " + std::to_string(pattern_.stitches.size());
            if (!json.is_array() || json.size() < 2)
                fail(VFIT_ERROR_DATA, "pattern: ", what, " does not pair: it names fewer than two edges");
            Stitch stitch;
            stitch.a = read_side(json[0], what);
            stitch.b = read_side(json[1], what);
            stitch.turned = json.size() == 3 && json[2] == "right_wrong";
            if (json.size() > 2 && !stitch.turned)
                fail(VFIT_ERROR_DATA, "pattern: ", what, " has a third part that is not \"right_wrong\"");
            pattern_.stitches.push_back(stitch);
        }
    }

    EdgeName read_side(const Json& json, const std::string& what) const {
        const Json& name = field(json, "panel", what);
        const auto panel = name.is_string() ? panel_of_.find(name.get<std::string>()) : panel_of_.end();
        if (panel == panel_of_.end())
            fail(VFIT_ERROR_DATA, "pattern: ", what, " names a panel ", name.dump(), " that is not there");
        const size_t edges = pattern_.panels[panel->second].edges.size();
        return {panel->second,
                index(field(json, "edge", what), edges, what + ": the edge of panel " + panel->first)};
    }

    /// What is no garment's size in the unit that the file tells is so mostly because of the unit.
    void check_unit() const {
        constexpr float kSmallest_m = 0.1f, kLargest_m = 4.0f;
        std::vector<float> sizes;
        for (const Panel& panel : pattern_.panels) {
            sizes.push_back(0.0f);
            for (const Vec2& a : panel.corners)
                sizes.back() = std::max(sizes.back(), glm::length(a - panel.corners[0]));
        }
        std::sort(sizes.begin(), sizes.end());
        const float largest = sizes.back(), usual = sizes[sizes.size() / 2];  // a single ruffle may be long
        if (largest >= kSmallest_m && usual <= kLargest_m) return;
        const float raw = largest * units_in_meter_;
        const char* fits =
            raw >= kSmallest_m && raw <= kLargest_m                       ? "metres: units_in_meter 1"
            : raw >= 100.0f * kSmallest_m && raw <= 100.0f * kLargest_m   ? "centimetres: units_in_meter 100"
            : raw >= 1000.0f * kSmallest_m && raw <= 1000.0f * kLargest_m ? "millimetres: units_in_meter 1000"
                                                                          : nullptr;
        fail(VFIT_ERROR_DATA, "pattern: its largest panel is ", largest,
             " m long by its own unit (units_in_meter ", units_in_meter_, ")",
             fits ? std::string(": the numbers look like ") + fits : std::string(": no garment is"));
    }

    const Json& root_;
    Pattern pattern_;
    std::map<std::string, uint32_t> panel_of_;
    float units_in_meter_ = 100.0f;
    bool relative_ = true;
};

}  // namespace

bool is_garmentcode(std::span<const std::byte> json) {
    const Json root = parse_json(json, "pattern");
    return root.is_object() && root.contains("pattern") && root["pattern"].is_object() &&
           root["pattern"].contains("panels");
}

Pattern parse_garmentcode(std::span<const std::byte> json, const std::string& name) {
    const Json root = parse_json(json, "pattern");
    return SpecificationReader(root, name).read();
}

}  // namespace vfit
