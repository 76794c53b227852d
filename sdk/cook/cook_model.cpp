#include "cook/cook_model.h"

#include <algorithm>
#include <cmath>

#include "cloth/garment/cut.h"
#include "cook/body/cook_body.h"
#include "cook/drape/grow_body.h"
#include "cook/model/stand.h"
#include "cook/model/surface.h"
#include "cook/worn.h"
#include "core/clock.h"
#include "core/error.h"

namespace vfit {

namespace {

/// Sleeves: what is nearer to an arm than to the trunk, in patches that reach along the upper arm; others
/// only hang beside a hand.
std::vector<uint8_t> sleeves(const Surface& surface, const std::vector<Vec3>& places, const CookBody& body) {
    constexpr float kAlong_m = 0.08f;  // from the shoulder joint
    const size_t count = places.size();
    std::vector<uint8_t> near_arm(count, 0), seed(count, 0);
    for (size_t v = 0; v < count; ++v) {
        const MeshQuery::Closest skin = body.skin().closest(places[v]);
        const BodyPart part = body.parts()[body.indices()[3 * skin.triangle]];
        near_arm[v] = is_arm(part);
        Vec3 joint = body.outline().left_shoulder();
        if (places[v].x < 0.0f) joint.x = -joint.x;
        seed[v] = (part == BodyPart::kLeftUpperArm || part == BodyPart::kRightUpperArm) &&
                  glm::length(skin.point - joint) > kAlong_m;
    }
    std::vector<std::vector<uint32_t>> beside(count);
    for (size_t i = 0; i < surface.indices.size(); ++i)
        beside[surface.indices[i]].push_back(surface.indices[i - i % 3 + (i + 1) % 3]);
    std::vector<uint8_t> out(count, 0);
    std::vector<uint32_t> open;
    for (uint32_t v = 0; v < count; ++v)
        if (seed[v]) out[v] = 1, open.push_back(v);
    while (!open.empty()) {
        const uint32_t v = open.back();
        open.pop_back();
        for (const uint32_t other : beside[v])
            if (near_arm[other] && !out[other]) out[other] = 1, open.push_back(other);
    }
    return out;
}

void add_notes(const WholeCloth& cloth, float thickness_m, const Standing& standing, const Draped& draped,
               std::vector<std::string>& notes) {
    const auto percent = [](float share) { return int(share * 100.0f + 0.5f); };
    constexpr float kMuch = 0.05f;
    if (standing.moved.z != 0.0f)
        notes.push_back(text("it stood ", percent(std::abs(standing.moved.z)), " cm too far ",
                             standing.moved.z < 0.0f ? "forward" : "back", " and was moved"));
    if (standing.inside_share > kMuch)
        notes.push_back(text(percent(standing.inside_share),
                             " % of the vertices lay in the default body, up to ",
                             percent(standing.deepest_m),
                             " cm deep: it was modelled on a slimmer body, or on one whose arms are held "
                             "otherwise (ours at about 45 degrees)"));
    constexpr float kCoarse_m = 0.04f;
    const int side_mm = int(mean_side(cloth) * 1000.0f + 0.5f);
    if (mean_side(cloth) > kCoarse_m)
        notes.push_back(
            text("its triangles are ", side_mm, " mm large: it will fold coarsely (20 mm do well)"));
    if (!keeps_layers_apart(cloth, thickness_m))
        notes.push_back(text(
            "its triangles are ", side_mm,
            " mm large: too small for its own layers to be kept apart while it settled (20 mm do well)"));
    add_drape_notes(draped.report, notes);
    if (std::find(draped.simulated.begin(), draped.simulated.end(), 0) == draped.simulated.end())
        notes.push_back("it is held nowhere: all of it is simulated, and may slide off");
}

}  // namespace

CookedGarment cook_model(const BodyModel& body_model, const Model& model, const FabricLibrary& fabrics,
                         const ModelOptions& options, Jobs& jobs) {
    const Stopwatch watch;
    Surface surface = make_surface(model, options.unit_m);
    const FabricMaterial material = fabrics.get(options.cook.fabric);
    const CookBody made_on(body_model, options.cook.sex, options.cook.shape);
    const MeshQuery& skin = made_on.skin();
    const float thickness = options.cook.drape.thickness_m;
    const Standing standing = stand(surface, made_on.outline(), skin, thickness);

    CookedGarment out;
    Garment& g = out.garment;
    g.name = options.name;
    g.kind = options.cook.kind;
    g.size_chart = options.cook.size_chart;
    g.fabric = options.cook.fabric;
    g.body_sex = made_on.sex();
    g.body_shape = made_on.settings();
    g.mesh.indices = surface.indices;
    g.mesh.uvs = surface.uvs;
    g.copies = surface.copies;
    g.corners = surface.corners;
    g.cut_shape = surface.positions;
    const std::vector<Vec2> cut = cut_corners(g);
    const WholeCloth cloth{surface.indices, cut, &material};
    constexpr float kOtherBody = 0.005f;  // of its vertices that lie well within ours
    constexpr Stance kThinnest{0.2f};
    std::vector<Vec3> places = standing.places;
    if (options.cook.drape.watch) options.cook.drape.watch("placed", places);
    if (standing.inside_share > kOtherBody)
        places = grow_body_into(cloth, std::move(places), made_on, kThinnest, {}, thickness, jobs);
    const Draped draped = settle(cloth, pushed_out(std::move(places), skin, thickness), standing.hold,
                                 made_on, options.cook.drape, jobs);
    out.report = draped.report;
    out.report.hangs_on = standing.hangs_on;
    out.report.raised_m = standing.moved.y;
    g.mesh.positions = draped.positions;
    g.simulated = draped.simulated;
    g.backstop.assign(g.vertex_count(), 0);
    g.on_arm = sleeves(surface, draped.positions, made_on);
    g.parts = std::move(surface.parts);
    if (!options.size_label.empty()) g.sizes.push_back({options.size_label, {}, {}});
    turn_outside_out(g, skin);
    validate_garment(g, fabrics);
    out.round = goes_round(g.mesh.positions, g.mesh.indices, made_on);
    check_worn(out.round, options.cook.kind_told ? options.cook.kind : "");

    out.notes = model.notes;
    out.notes.insert(out.notes.end(), surface.notes.begin(), surface.notes.end());
    add_notes(cloth, thickness, standing, draped, out.notes);
    for (const auto& opening : surface.openings) out.openings_m.push_back(surface.length_of(opening));
    out.report.seconds = watch.ms() / 1000.0;
    return out;
}

}  // namespace vfit
