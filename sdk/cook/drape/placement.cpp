#include "cook/drape/placement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/error.h"

namespace vfit {

namespace {

constexpr float kClear_m = 0.02f;      // between a panel and the body
constexpr float kFarthest_m = 0.8f;    // that a panel is moved for that
constexpr float kAboveSkin_m = 0.01f;  // a shoulder seam
constexpr float kAboveFeet_m =
    0.12f;  // of the soles: there a leg's hem closes around the ankle, not around the foot

/// An edge as it is placed.
struct PlacedEdge {
    Vec3 middle, way;  // way: from its begin to its end
};

PlacedEdge placed(const Panel& panel, const PatternEdge& edge) {
    const auto lift = [&](const Vec2& p) { return panel.rotation * Vec3(p, 0.0f) + panel.translation; };
    const std::vector<Vec2> line = sample_edge(panel, edge, 2);
    return {lift(line[1]), lift(line[2]) - lift(line[0])};
}

struct Heights {
    float low = INFINITY, high = -INFINITY;
};

Heights heights_of(const Panel& panel) {
    Heights h;
    for (const Vec2& p : panel.corners) {
        const float y = (panel.rotation * Vec3(p, 0.0f) + panel.translation).y;
        h.low = std::min(h.low, y), h.high = std::max(h.high, y);
    }
    return h;
}

float depth_of(const Panel& panel) {
    float sum = 0.0f;
    for (const Vec2& p : panel.corners) sum += (panel.rotation * Vec3(p, 0.0f) + panel.translation).z;
    return sum / float(panel.corners.size());
}

float lowest(const Pattern& pattern) {
    float y = INFINITY;
    for (const Panel& panel : pattern.panels) y = std::min(y, heights_of(panel).low);
    return y;
}

class Hanger {
public:
    Hanger(const Pattern& pattern, const SewnMesh& mesh, const BodyOutline& outline)
        : pattern_(pattern), mesh_(mesh), outline_(outline) {}

    std::optional<float> by_shoulders() const {
        float sum = 0.0f;
        int count = 0;
        for (const Stitch& stitch : front_to_back()) {
            const PlacedEdge a = edge(stitch.a), b = edge(stitch.b);
            const Vec3 middle = 0.5f * (a.middle + b.middle);
            const auto level = [](const PlacedEdge& e) { return std::abs(e.way.x) > std::abs(e.way.y); };
            const auto on_top = [&](const EdgeName& name, const PlacedEdge& e) {
                const Heights h = heights_of(pattern_.panels[name.panel]);
                return e.middle.y > h.high - 0.2f * (h.high - h.low);
            };
            constexpr float kInner_m = 0.03f, kOuter_m = 0.25f;  // of shoulders, from the middle
            if (!level(a) || !level(b) || !on_top(stitch.a, a) || !on_top(stitch.b, b)) continue;
            if (std::abs(middle.x) < kInner_m || std::abs(middle.x) > kOuter_m) continue;
            const auto hit =
                outline_.skin().cast({middle.x, 3.0f, outline_.left_shoulder().z}, {0, -1, 0}, 3.0f);
            if (!hit) continue;
            sum += 3.0f - hit->distance + kAboveSkin_m - middle.y;
            ++count;
        }
        return count > 0 ? std::optional(sum / float(count)) : std::nullopt;
    }

    /// Where the crotch is at the body's. The highest end of seams between front and back that run down the
    /// inside of both legs.
    std::optional<float> by_crotch() const {
        constexpr float kMiddle_m = 0.1f;
        float crotch = -INFINITY;
        bool left = false, right = false;
        for (const Stitch& stitch : front_to_back()) {
            for (const EdgeName& name : {stitch.a, stitch.b}) {
                const Panel& panel = pattern_.panels[name.panel];
                const PlacedEdge e = edge(name);
                if (std::abs(e.way.y) < 2.0f * std::abs(e.way.x) || std::abs(e.way.y) < 0.05f) continue;
                const float top_x = e.middle.x + 0.5f * (e.way.y > 0.0f ? e.way.x : -e.way.x),
                            top_y = e.middle.y + 0.5f * std::abs(e.way.y);
                const float center_x = 0.5f * (extent_x(panel).x + extent_x(panel).y);
                if (std::abs(top_x) > kMiddle_m || std::abs(e.middle.x) > std::abs(center_x)) continue;
                (center_x > 0.0f ? left : right) = true;
                crotch = std::max(crotch, top_y);
            }
        }
        if (!left || !right) return std::nullopt;
        const auto hit =
            outline_.skin().cast({0.0f, outline_.levels().knee, outline_.axis_z()}, {0, 1, 0}, 1.0f);
        if (!hit) return std::nullopt;
        constexpr float kBelow_m = 0.02f;
        return outline_.levels().knee + hit->distance - kBelow_m - crotch;
    }

    /// The upper border where it is worn.
    std::optional<float> by_waist() const {
        if (upper_border().empty()) return std::nullopt;
        const float raised = pattern_.worn_top_m.value_or(outline_.levels().waist) -
                             border_height();  // what is wider than it is worn with a belt
        const auto crotch = by_crotch();
        return crotch ? std::min(raised, *crotch) : raised;
    }

    float border_height() const {
        float length = 0.0f, height = 0.0f;
        for (const EdgeName& name : upper_border()) {
            const float l =
                edge_length(pattern_.panels[name.panel], pattern_.panels[name.panel].edges[name.edge]);
            length += l, height += l * edge(name).middle.y;
        }
        return height / length;
    }

    /// Unsewn edges near the top.
    std::vector<EdgeName> upper_border() const {
        std::vector<EdgeName> out;
        float top = -INFINITY;
        for (uint32_t p = 0; p < pattern_.panels.size(); ++p)
            top = std::max(top, heights_of(pattern_.panels[p]).high);
        for (uint32_t p = 0; p < pattern_.panels.size(); ++p)
            for (uint32_t e = 0; e < pattern_.panels[p].edges.size(); ++e) {
                const PlacedEdge at = edge({p, e});
                constexpr float kNearTop_m = 0.05f;
                if (is_sewn({p, e}) || at.middle.y < top - kNearTop_m) continue;
                out.push_back({p, e});
            }
        return out;
    }

private:
    PlacedEdge edge(const EdgeName& name) const {
        return placed(pattern_.panels[name.panel], pattern_.panels[name.panel].edges[name.edge]);
    }
    bool is_sewn(const EdgeName& name) const {
        return std::any_of(pattern_.stitches.begin(), pattern_.stitches.end(),
                           [&](const Stitch& s) { return s.a == name || s.b == name; });
    }
    std::vector<Stitch> front_to_back() const {
        std::vector<Stitch> out;
        for (const Stitch& s : pattern_.stitches)
            if ((depth_of(pattern_.panels[s.a.panel]) > outline_.axis_z()) !=
                (depth_of(pattern_.panels[s.b.panel]) > outline_.axis_z()))
                out.push_back(s);
        return out;
    }
    static Vec2 extent_x(const Panel& panel) {
        Vec2 e(INFINITY, -INFINITY);
        for (const Vec2& p : panel.corners) {
            const float x = (panel.rotation * Vec3(p, 0.0f) + panel.translation).x;
            e = {std::min(e.x, x), std::max(e.y, x)};
        }
        return e;
    }

    const Pattern& pattern_;
    const SewnMesh& mesh_;
    const BodyOutline& outline_;
};

}  // namespace

Placement place_panels(const Pattern& pattern, const SewnMesh& mesh, const BodyOutline& outline,
                       const MeshQuery& skin) {
    Placement out;
    const Hanger hanger(pattern, mesh, outline);
    if (const auto by = hanger.by_shoulders())
        out.hangs_on = HangsOn::shoulders, out.raised_m = *by;
    else if (const auto waist = hanger.by_waist())
        out.hangs_on = HangsOn::waist, out.raised_m = *waist, out.band = hanger.upper_border(),
        out.band_m = hanger.border_height() + *waist;
    if (const auto crotch = hanger.by_crotch())
        out.lifted_m = std::clamp(kAboveFeet_m - lowest(pattern) - out.raised_m, 0.0f,
                                  std::max(0.0f, *crotch - out.raised_m));

    for (size_t p = 0; p < pattern.panels.size(); ++p) {
        const Panel& panel = pattern.panels[p];
        const PanelMesh& flat = mesh.panels[p];
        const Vec3 raised = panel.translation + Vec3(0, out.raised_m + out.lifted_m, 0);
        Vec3 middle(0.0f);
        for (const Vec2& v : flat.flat)
            middle += (panel.rotation * Vec3(v, 0.0f) + raised) / float(flat.flat.size());
        Vec3 outward = panel.rotation * Vec3(0, 0, 1);
        const MeshQuery::Closest near = skin.closest(middle);
        if (glm::dot(outward, middle - near.point) * (skin.inside(middle) ? -1.0f : 1.0f) < 0.0f)
            outward = -outward;
        constexpr float kStep_m = 0.01f;
        float moved = 0.0f;
        std::vector<Vec3> places(flat.flat.size());
        for (bool clear = false; !clear; moved += kStep_m) {
            if (moved > kFarthest_m)
                fail(VFIT_ERROR_DATA, "panel ", panel.name,
                     " cannot be placed clear of the body: it cuts it wherever it is moved to along its own "
                     "normal");
            clear = true;
            for (size_t i = 0; i < places.size(); ++i) {
                places[i] = panel.rotation * Vec3(flat.flat[i], 0.0f) + raised + outward * moved;
                if (clear && skin.signed_distance(places[i]) < kClear_m) clear = false;
            }
        }
        out.places.insert(out.places.end(), places.begin(), places.end());
    }
    return out;
}

}  // namespace vfit
