#include "cook/cook_pattern.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>

#include "cook/body/cook_body.h"
#include "cook/worn.h"
#include "core/error.h"

namespace vfit {

namespace {

/// Vertices of panels in the order in which a garment has them: the first of each sewn vertex, then its
/// copies.
struct DrawnOrder {
    std::vector<uint32_t> panel_vertices;  // one a vertex and copy
    std::vector<uint32_t> copies;          // sewn vertices
    std::vector<uint32_t> place_of;        // of a panel vertex

    explicit DrawnOrder(const SewnMesh& mesh)
        : panel_vertices(mesh.sewn_count, UINT32_MAX), place_of(mesh.panel_vertex_count()) {
        for (uint32_t v = 0; v < mesh.panel_vertex_count(); ++v) {
            uint32_t& first = panel_vertices[mesh.sewn_of[v]];
            if (first == UINT32_MAX) first = v, place_of[v] = mesh.sewn_of[v];
        }
        for (uint32_t v = 0; v < mesh.panel_vertex_count(); ++v) {
            if (panel_vertices[mesh.sewn_of[v]] == v) continue;
            place_of[v] = uint32_t(panel_vertices.size());
            panel_vertices.push_back(v);
            copies.push_back(mesh.sewn_of[v]);
        }
    }
    std::vector<Vec2> pick(const std::vector<Vec2>& of_panels) const {
        std::vector<Vec2> out;
        for (const uint32_t v : panel_vertices) out.push_back(of_panels[v]);
        return out;
    }
};

/// Sleeves: of panels that lie against an arm for the most part, all vertices that no other panel has.
std::vector<uint8_t> on_arms(const SewnMesh& mesh, const std::vector<Vec3>& places, const CookBody& body) {
    std::vector<uint8_t> out(mesh.sewn_count, 0);
    std::vector<uint32_t> elsewhere(mesh.sewn_count, 0);
    for (size_t p = 0; p < mesh.panels.size(); ++p) {
        size_t on = 0;
        const size_t count = mesh.panels[p].flat.size();
        for (uint32_t v = 0; v < count; ++v) {
            const MeshQuery::Closest skin =
                body.skin().closest(places[mesh.sewn_of[mesh.first_vertex[p] + v]]);
            on += is_arm(body.parts()[body.indices()[3 * skin.triangle]]);
        }
        const bool sleeve = 2 * on > count;
        for (uint32_t v = 0; v < count; ++v) {
            const uint32_t sewn = mesh.sewn_of[mesh.first_vertex[p] + v];
            if (sleeve)
                out[sewn] = 1;
            else
                elsewhere[sewn] = 1;
        }
    }
    for (uint32_t v = 0; v < mesh.sewn_count; ++v)
        if (elsewhere[v]) out[v] = 0;
    return out;
}

std::vector<GarmentPart> parts_of(const Pattern& pattern, const SewnMesh& mesh) {
    std::vector<GarmentPart> parts;
    for (size_t p = 0; p < pattern.panels.size(); ++p) {
        PatternMaterial material{"cloth", "", {0.8f, 0.8f, 0.8f}};
        if (!pattern.materials.empty()) material = pattern.materials[0];
        for (const PatternMaterial& m : pattern.materials)
            if (m.name == pattern.panels[p].material) material = m;
        const uint32_t first = mesh.first_triangle[p], count = mesh.first_triangle[p + 1] - first;
        if (!parts.empty() && parts.back().material == material.name)
            parts.back().triangle_count += count;
        else
            parts.push_back({material.name, material.texture,
                             Vec3(material.color[0], material.color[1], material.color[2]), first, count});
    }
    return parts;
}

/// In pictures v runs down; in patterns y runs up.
std::vector<Vec2> uvs_of(std::vector<Vec2> flat) {
    for (Vec2& p : flat) p.y = -p.y;
    return flat;
}

}  // namespace

uint32_t crossings_of(const std::vector<CookedGarment>& garments) {
    uint32_t sum = 0;
    for (const CookedGarment& cooked : garments) sum += cooked.report.crossings();
    return sum;
}

void turn_outside_out(Garment& g, const MeshQuery& skin) {
    double outwards = 0.0;
    compute_normals(g.mesh.positions, g.mesh.indices, g.mesh.normals);
    for (size_t i = 0; i < g.mesh.positions.size(); ++i)
        outwards +=
            glm::dot(g.mesh.normals[i], g.mesh.positions[i] - skin.closest(g.mesh.positions[i]).point);
    if (outwards >= 0.0) return;
    for (std::vector<uint32_t>* list : {&g.mesh.indices, &g.corners})
        for (size_t i = 0; i + 2 < list->size(); i += 3) std::swap((*list)[i + 1], (*list)[i + 2]);
    compute_normals(g.mesh.positions, g.mesh.indices, g.mesh.normals);
}

void add_drape_notes(const DrapeReport& report, std::vector<std::string>& notes) {
    constexpr float kStretched = 0.2f;
    if (report.strain_p99 > kStretched)
        notes.push_back(text("it is stretched on this body: a hundredth of its sides by ",
                             std::lround(100.0f * report.strain_p99), " % or more"));
    if (report.skin_crossings > 0)
        notes.push_back(text("the skin stands out of it in ", report.skin_crossings,
                             " places, most of them at the ", report.crossed_at));
    if (report.self_crossings > 0)
        notes.push_back(text("it crosses itself in ", report.self_crossings, " places"));
}

namespace {

CookedGarment cook_once(const CookBody& body, const std::vector<PatternSize>& sizes, size_t base,
                        const FabricLibrary& fabrics, const CookOptions& options, float triangle_m,
                        const Stance& stance, Jobs& jobs) {
    const Pattern& pattern = sizes[base].pattern;
    const SewnMesh mesh = sew(pattern, triangle_m);
    const FabricMaterial material = fabrics.get(options.fabric);

    const Draped draped =
        drape(pattern, mesh, material, body, stance, place_panels(pattern, mesh, body.outline(), body.skin()),
              options.drape, jobs);

    const DrawnOrder order(mesh);
    CookedGarment out;
    out.report = draped.report;
    Garment& g = out.garment;
    g.name = pattern.name;
    g.kind = options.kind;
    g.size_chart = options.size_chart;
    g.fabric = options.fabric;
    g.body_sex = body.sex();
    g.body_shape = body.settings();
    g.mesh.positions = draped.positions;
    g.mesh.indices = mesh.sewn_indices;
    g.copies = order.copies;
    for (const uint32_t v : mesh.panel_indices) g.corners.push_back(order.place_of[v]);
    g.flat = order.pick(mesh.flat());
    g.mesh.uvs = uvs_of(g.flat);
    g.simulated = draped.simulated;
    g.backstop.assign(mesh.sewn_count, 0);
    g.on_arm = on_arms(mesh, draped.positions, body);
    g.parts = parts_of(pattern, mesh);
    for (const PatternSize& size : sizes) {
        if (size.label.empty()) continue;
        try {
            check_pattern(size.pattern);
            g.sizes.push_back(
                {size.label, size.nominal, order.pick(mesh.flat_of_size(pattern, size.pattern))});
        } catch (const Error& error) {
            fail(error.code(), "size ", size.label, ": ", error.what());
        }
    }
    turn_outside_out(g, body.skin());
    validate_garment(g, fabrics);
    out.round = goes_round(g.mesh.positions, g.mesh.indices, body);
    add_drape_notes(out.report, out.notes);
    return out;
}

/// About the body at rest; then about a thin one that grows in the garment, for sleeves that are narrow for
/// the arms, with legs together, for skirts that are narrow for legs apart, and with arms level, so that
/// sleeves cut in one with the front close below them, and a wide skirt does not catch on hands.
std::vector<Stance> stances(const Pattern& pattern, const CookBody& body) {
    Stance thin(0.6f);
    if (!has_legs(pattern, body.outline())) body.put_legs_together(thin);
    Stance arms_level = thin;
    body.hold_arms_level(arms_level);
    if (has_sleeves(pattern, body.outline())) return {Stance(), thin, arms_level};
    return {Stance(), arms_level};
}

}  // namespace

CookedGarment cook_pattern(const BodyModel& model, const std::vector<PatternSize>& sizes, size_t base,
                           const FabricLibrary& fabrics, const CookOptions& options, Jobs& jobs) {
    if (base >= sizes.size()) fail(VFIT_ERROR_ARGUMENT, "there is no size ", base);
    check_pattern(sizes[base].pattern);
    const CookBody body(model, options.sex, options.shape);
    constexpr size_t kEnoughVertices = 24000;  // of all tries: about 30 s
    size_t tried_vertices = 0;
    double seconds = 0.0;
    std::optional<CookedGarment> best;
    Stance of_best;
    std::exception_ptr fault;
    const auto cook = [&](const Stance stance, float triangles) {
        if (best && (best->report.crossings() == 0 || tried_vertices > kEnoughVertices)) return;
        try {
            CookedGarment cooked =
                cook_once(body, sizes, base, fabrics, options, options.triangle_m * triangles, stance, jobs);
            seconds += cooked.report.seconds;
            tried_vertices += cooked.garment.vertex_count();
            if (best && cooked.report.crossings() >= best->report.crossings()) return;
            best = std::move(cooked);
            of_best = stance;
        } catch (const Error&) {
            if (!fault) fault = std::current_exception();
        }
    };
    for (const Stance& stance : stances(sizes[base].pattern, body)) cook(stance, 1.0f);
    if (!best) std::rethrow_exception(fault);
    // Whether a fold gets caught when cloth falls from where it was sewn is chance: with triangles of a
    // little another size it falls anew.
    for (const float triangles : {0.95f, 1.05f, 0.9f}) cook(of_best, triangles);
    check_worn(best->round, options.kind_told ? options.kind : "");
    best->report.seconds = seconds;
    return std::move(*best);
}

}  // namespace vfit
