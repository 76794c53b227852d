#include "cook/drape/placement.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "cook/drape/upper_edge.h"
#include "core/error.h"
#include "geometry/borders.h"

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
    Hanger(const Pattern& pattern, const BodyOutline& outline) : pattern_(pattern), outline_(outline) {}

    /// What brings the seams over the shoulders onto the body's; seams: adds those stitches. Where panels
    /// stand where they are worn, seams far off the shoulders are those of collars and hoods.
    std::optional<float> by_shoulders(std::vector<Stitch>& seams) const {
        constexpr float kInner_m = 0.03f, kOuter_m = 0.25f;  // of shoulders, from the middle
        constexpr float kFarOff_m = 0.08f;
        float sum = 0.0f;
        for (const Stitch& stitch : front_to_back()) {
            const PlacedEdge a = edge(stitch.a), b = edge(stitch.b);
            const Vec3 middle = 0.5f * (a.middle + b.middle);
            const auto level = [](const PlacedEdge& e) { return std::abs(e.way.x) > std::abs(e.way.y); };
            const auto on_top = [&](const EdgeName& name, const PlacedEdge& e) {
                const Heights h = heights_of(pattern_.panels[name.panel]);
                return e.middle.y > h.high - 0.2f * (h.high - h.low);
            };
            if (!level(a) || !level(b) || !on_top(stitch.a, a) || !on_top(stitch.b, b)) continue;
            if (std::abs(middle.x) < kInner_m || std::abs(middle.x) > kOuter_m) continue;
            const auto hit =
                outline_.skin().cast({middle.x, 3.0f, outline_.left_shoulder().z}, {0, -1, 0}, 3.0f);
            if (!hit) continue;
            const float raised = 3.0f - hit->distance + kAboveSkin_m - middle.y;
            if (pattern_.worn_as_placed && std::abs(raised) > kFarOff_m) continue;
            sum += raised;
            seams.push_back(stitch);
        }
        return seams.empty() ? std::nullopt : std::optional(sum / float(seams.size()));
    }

    /// Where the crotch is at the body's. The highest end of seams between front and back that run down the
    /// inside of both legs.
    std::optional<float> by_crotch() const {
        constexpr float kMiddle_m = 0.1f;
        constexpr float kHighest = 0.75f;  // of the garment's height: above are the seams of a hood
        float crotch = -INFINITY, low = INFINITY, high = -INFINITY;
        for (const Panel& panel : pattern_.panels) {
            const Heights h = heights_of(panel);
            low = std::min(low, h.low), high = std::max(high, h.high);
        }
        bool left = false, right = false;
        for (const Stitch& stitch : front_to_back()) {
            for (const EdgeName& name : {stitch.a, stitch.b}) {
                const Panel& panel = pattern_.panels[name.panel];
                const PlacedEdge e = edge(name);
                if (std::abs(e.way.y) < 2.0f * std::abs(e.way.x) || std::abs(e.way.y) < 0.05f) continue;
                const float top_x = e.middle.x + 0.5f * (e.way.y > 0.0f ? e.way.x : -e.way.x),
                            top_y = e.middle.y + 0.5f * std::abs(e.way.y);
                const float center_x = 0.5f * (extent_x(panel).x + extent_x(panel).y);
                if (top_y > glm::mix(low, high, kHighest) || std::abs(top_x) > kMiddle_m ||
                    std::abs(e.middle.x) > std::abs(center_x))
                    continue;
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

    /// The upper edge, whose mean height is that one, where it is worn.
    float by_waist(float own_m) const {
        constexpr float kAboveWaist_m = 0.12f;
        if (pattern_.worn_as_placed ||
            (!pattern_.worn_top_m && own_m > outline_.levels().waist + kAboveWaist_m))
            return 0.0f;
        const float raised = pattern_.worn_top_m.value_or(outline_.levels().waist) -
                             own_m;  // what is wider than it is worn with a belt
        const auto crotch = by_crotch();
        return crotch ? std::min(raised, *crotch) : raised;
    }

private:
    PlacedEdge edge(const EdgeName& name) const {
        return placed(pattern_.panels[name.panel], pattern_.panels[name.panel].edges[name.edge]);
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
    const BodyOutline& outline_;
};

/// Of the panels, where they are placed: one place a sewn vertex.
std::vector<Vec3> sewn_places(const Pattern& pattern, const SewnMesh& mesh) {
    std::vector<Vec3> out(mesh.sewn_count, Vec3(0.0f));
    std::vector<float> count(mesh.sewn_count, 0.0f);
    for (size_t p = 0; p < pattern.panels.size(); ++p)
        for (uint32_t v = 0; v < mesh.panels[p].flat.size(); ++v) {
            const uint32_t sewn = mesh.sewn_of[mesh.first_vertex[p] + v];
            out[sewn] += pattern.panels[p].rotation * Vec3(mesh.panels[p].flat[v], 0.0f) +
                         pattern.panels[p].translation;
            count[sewn] += 1.0f;
        }
    for (uint32_t v = 0; v < mesh.sewn_count; ++v) out[v] /= count[v];
    return out;
}

void check_near(const Pattern& pattern, const BodyOutline& outline) {
    constexpr float kFar_m = 2.0f, kFarUp_m = 10.0f;  // garments have many heights of their own
    for (const Panel& panel : pattern.panels) {
        Vec3 middle(0.0f);
        for (const Vec2& p : panel.corners)
            middle += (panel.rotation * Vec3(p, 0.0f) + panel.translation) / float(panel.corners.size());
        const float off_m = glm::length(Vec2(middle.x, middle.z - outline.axis_z()));
        if (!(off_m <= kFar_m))
            fail(VFIT_ERROR_DATA, "panel ", panel.name, " is placed ", std::round(10.0f * off_m) / 10.0f,
                 " m beside the body: panels have to stand around (0, 0)");
        if (!(std::abs(middle.y) <= kFarUp_m))
            fail(VFIT_ERROR_DATA, "panel ", panel.name, " is placed at ", middle.y,
                 " m of height: panels have to stand around the body");
    }
}

/// What no seam joins to that by which the garment is held would fall to the floor.
void check_held(const Pattern& pattern, const SewnMesh& mesh, const Hold& hold) {
    std::vector<uint32_t> root(mesh.sewn_count);
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](uint32_t v) {
        while (root[v] != v) v = root[v] = root[root[v]];
        return v;
    };
    for (size_t i = 0; i < mesh.sewn_indices.size(); ++i)
        root[find(mesh.sewn_indices[i])] = find(mesh.sewn_indices[i - i % 3 + (i + 1) % 3]);
    std::set<uint32_t> held;
    for (uint32_t v = 0; v < hold.of.size(); ++v)
        if (hold.of[v]) held.insert(find(v));
    if (held.empty())
        fail(VFIT_ERROR_DATA,
             "the garment hangs on nothing: it has neither a seam over the shoulders nor an edge around the "
             "body");
    for (size_t p = 0; p < pattern.panels.size(); ++p)
        if (!held.count(find(mesh.sewn_of[mesh.first_vertex[p]])))
            fail(VFIT_ERROR_DATA, "panel ", pattern.panels[p].name,
                 " hangs on nothing: no seam joins it to what the garment is held by");
}

/// Seams over the shoulders stay where the pattern has them between neck and arm while they are sewn and
/// fall: without hands that put it right, a wide neckline slides down an arm.
void hold_shoulders(const SewnMesh& mesh, const std::vector<Stitch>& seams, const std::vector<Vec3>& places,
                    const BodyOutline& outline, Hold& hold) {
    constexpr float kSlack_m = 0.015f;
    hold.of.assign(mesh.sewn_count, 0);
    hold.at.assign(mesh.sewn_count, Vec3(0.0f));
    hold.slack_m = kSlack_m;
    hold.worn_by = false;
    for (const Stitch& seam : seams)
        for (const uint32_t v : mesh.panels[seam.a.panel].edge_vertices[seam.a.edge]) {
            const uint32_t sewn = mesh.sewn_of[mesh.first_vertex[seam.a.panel] + v];
            const auto ridge = outline.shoulder_ridge(places[sewn].x);
            if (!ridge) continue;
            hold.of[sewn] = 1;
            hold.at[sewn] = *ridge + Vec3(0.0f, kAboveSkin_m, 0.0f);
        }
}

}  // namespace

bool has_legs(const Pattern& pattern, const BodyOutline& outline) {
    return Hanger(pattern, outline).by_crotch().has_value();
}

bool has_sleeves(const Pattern& pattern, const BodyOutline& outline) {
    return std::any_of(pattern.panels.begin(), pattern.panels.end(), [&](const Panel& panel) {
        Vec3 middle(0.0f);
        for (const Vec2& p : panel.corners)
            middle += (panel.rotation * Vec3(p, 0.0f) + panel.translation) / float(panel.corners.size());
        return std::abs(middle.x) > outline.left_shoulder().x && middle.y > outline.levels().waist;
    });
}

Placement place_panels(const Pattern& pattern, const SewnMesh& mesh, const BodyOutline& outline,
                       const MeshQuery& skin) {
    Placement out;
    const Hanger hanger(pattern, outline);
    const std::vector<Vec3> sewn = sewn_places(pattern, mesh);
    check_near(pattern, outline);
    std::vector<Stitch> seams;
    if (const auto by = hanger.by_shoulders(seams)) {
        out.hangs_on = HangsOn::shoulders, out.raised_m = *by;
        hold_shoulders(mesh, seams, sewn, outline, out.hold);
    } else if (const auto edge = upper_edge(sewn, borders(mesh.sewn_indices), outline.axis_z());
               !edge.empty()) {
        const float own_m = mean_height(sewn, edge);
        out.hangs_on = HangsOn::waist, out.raised_m = hanger.by_waist(own_m),
        out.band_m = own_m + out.raised_m;
        out.hold.of.assign(mesh.sewn_count, 0);
        for (const uint32_t v : edge) out.hold.of[v] = 1;
    }
    check_held(pattern, mesh, out.hold);
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
