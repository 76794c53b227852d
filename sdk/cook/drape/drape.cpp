#include "cook/drape/drape.h"

#include <algorithm>
#include <cmath>

#include "cloth/cloth.h"
#include "cook/drape/grow_body.h"
#include "cook/drape/upper_edge.h"
#include "core/clock.h"
#include "core/error.h"

namespace vfit {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f;
constexpr float kSewn_m = 0.0001f;   // as good as one place
constexpr float kClosed_m = 0.002f;  // the widest that a seam should be when its two sides become one
// Of a stitch's spring: thread pulls panels along, and stretches them by a little only; at the end it is
// pulled tight.
constexpr float kSewing_n_m = 400.0f, kClosing_n_m = 20000.0f;
constexpr float kStage_m = 0.02f;    // by which the widest seams close in a stage
constexpr float kLoosely_m = 0.04f;  // that shoulder seams may move while the body grows
constexpr int kFramesAStage = 3, kFramesToClose = 180;

/// Corners of the triangles in flat cloth, one an index.
std::vector<Vec2> cut_of(const std::vector<uint32_t>& panel_indices, const std::vector<Vec2>& flat) {
    std::vector<Vec2> cut;
    for (const uint32_t v : panel_indices) cut.push_back(flat[v]);
    return cut;
}

class Draper {
public:
    Draper(const Pattern& pattern, const SewnMesh& mesh, const FabricMaterial& material, const CookBody& body,
           const Stance& stance, const DrapeSettings& settings, Jobs& jobs)
        : pattern_(pattern),
          mesh_(mesh),
          material_(material),
          body_(body),
          stance_(stance),
          sewn_on_(body.leaving(stance, 0.0f)),
          settings_(settings),
          jobs_(jobs),
          cut_(cut_of(mesh.panel_indices, mesh.flat())) {}

    Draped run(const Placement& placement) {
        const Stopwatch watch;
        std::vector<Vec3> places = placement.places;
        look("placed", places);
        const float widest = close_seams(placement, places);
        look("sewn", places);
        check_closed(places);
        std::vector<Vec3> one(mesh_.sewn_count, Vec3(0.0f));
        std::vector<float> count(mesh_.sewn_count, 0.0f);
        for (uint32_t v = 0; v < places.size(); ++v)
            one[mesh_.sewn_of[v]] += places[v], count[mesh_.sewn_of[v]] += 1.0f;
        for (uint32_t v = 0; v < mesh_.sewn_count; ++v) one[v] /= count[v];
        DrapeSettings of_sewn = settings_;
        if (settings_.watch)
            of_sewn.watch = [this](const char* stage, const std::vector<Vec3>& sewn) {
                look(stage, spread(sewn));
            };
        const WholeCloth whole{mesh_.sewn_indices, cut_, &material_};
        if (!stance_.is_rest()) {
            Hold loosely = placement.hold;
            loosely.slack_m = kLoosely_m;
            if (loosely.worn_by) loosely.of.clear();
            one =
                grow_body_into(whole, std::move(one), body_, stance_, loosely, settings_.thickness_m, jobs_);
            if (of_sewn.watch) of_sewn.watch("grown", one);
        }
        const Hold hold = hold_of(placement, one);
        Draped out = settle(whole, std::move(one), hold, body_, of_sewn, jobs_);
        if (placement.hangs_on == HangsOn::shoulders &&
            std::count(out.simulated.begin(), out.simulated.end(), 0) == 0)
            fail(VFIT_ERROR_DATA,
                 "the garment slides off the shoulders of this body: no part of it lies on them when it has "
                 "fallen");
        out.report.hangs_on = placement.hangs_on;
        out.report.raised_m = placement.raised_m;
        out.report.widest_seam_m = widest;
        out.report.seconds = watch.ms() / 1000.0;
        return out;
    }

private:
    void look(const char* stage, const std::vector<Vec3>& panel_vertices) const {
        if (settings_.watch) settings_.watch(stage, panel_vertices);
    }
    std::vector<Vec3> spread(const std::vector<Vec3>& sewn) const {
        std::vector<Vec3> out;
        for (const uint32_t v : mesh_.sewn_of) out.push_back(sewn[v]);
        return out;
    }

    /// Pulls the two sides of the seams together, without gravity, as slowly as panels can slide around the
    /// body. The widest come first, and wait for nobody: those over the shoulders and around the body hold
    /// the garment up before a skirt is sewn on. Returns what the widest is apart at the end.
    float close_seams(const Placement& placement, std::vector<Vec3>& places) {
        constexpr float kShoulderSlack_m = 0.03f;
        const std::vector<uint8_t> all(places.size(), 1);
        const Hold& hold = placement.hold;
        std::vector<Vec3> targets = places;
        for (uint32_t v = 0; v < places.size() && !hold.at.empty(); ++v)
            if (hold.of[mesh_.sewn_of[v]]) targets[v] = hold.at[mesh_.sewn_of[v]];
        const FabricData panels = cook_fabric({places, mesh_.panel_indices, {}, all, 1.0f, cut_}, material_);
        ClothSettings settings;
        settings.gravity = Vec3(0.0f);
        settings.damping = 0.99999f;
        settings.friction = 0.0f;
        settings.sleeps = false;
        settings.thickness_m = settings_.thickness_m;
        for (float limit = widest_seam(places); limit > kSewn_m;) {
            limit = std::max(limit - kStage_m, kSewn_m);
            const bool last = limit == kSewn_m;
            FabricData data = panels;
            for (const SewnMesh::Pair& pair : mesh_.pairs)
                if (last || glm::length(places[pair.a] - places[pair.b]) > limit)
                    data.edges.push_back({pair.a, pair.b, limit, 1.0f / (last ? kClosing_n_m : kSewing_n_m)});
            for (uint32_t v = 0; v < places.size() && !hold.at.empty(); ++v)
                if (hold.of[mesh_.sewn_of[v]]) data.limits.push_back({v, 0.5f * limit + kShoulderSlack_m});
            Cloth cloth(std::make_shared<const Fabric>(std::move(data)), settings, places);
            const uint32_t skin = cloth.add_mesh(sewn_on_.size(), body_.indices(), but_fingers(body_));
            for (int frame = 0; frame < (last ? kFramesToClose : kFramesAStage); ++frame) {
                cloth.move_mesh(skin, sewn_on_);
                cloth.step(kFrame_s, targets, {}, jobs_);
                if (last && frame % 10 == 9 && widest_seam(cloth.positions()) < kClosed_m) break;
            }
            places = cloth.positions();
            if (settings_.watch && !last && int(limit / kStage_m) % 5 == 0) look("closing", places);
        }
        return widest_seam(places);
    }

    /// A garment may be too small for the body: then it is pulled as far as its cloth goes, and no further.
    void check_closed(const std::vector<Vec3>& places) const {
        constexpr float kOpen_m = 0.02f;
        for (const SewnMesh::Pair& pair : mesh_.pairs) {
            const float apart = glm::length(places[pair.a] - places[pair.b]);
            if (apart <= kOpen_m) continue;
            const Stitch& stitch = pattern_.stitches[pair.stitch];
            fail(VFIT_ERROR_DATA, "the seam of ", pattern_.text(stitch.a), " with ", pattern_.text(stitch.b),
                 " does not close on this body: ", apart * 100.0f,
                 " cm stay between them. The garment is too small for it, or its panels are placed so that a "
                 "limb is in between");
        }
    }

    float widest_seam(const std::vector<Vec3>& places) const {
        float widest = 0.0f;
        for (const SewnMesh::Pair& pair : mesh_.pairs)
            widest = std::max(widest, glm::length(places[pair.a] - places[pair.b]));
        return widest;
    }

    static Hold hold_of(const Placement& placement, const std::vector<Vec3>& sewn) {
        Hold hold = placement.hold;
        std::vector<uint32_t> edge;
        for (uint32_t v = 0; v < hold.of.size() && hold.worn_by; ++v)
            if (hold.of[v]) edge.push_back(v);
        if (!edge.empty()) hold.lowered_m = mean_height(sewn, edge) - placement.band_m;
        return hold;
    }

    const Pattern& pattern_;
    const SewnMesh& mesh_;
    const FabricMaterial& material_;
    const CookBody& body_;
    const Stance& stance_;
    std::vector<Vec3> sewn_on_;  // the skin while it is sewn
    const DrapeSettings& settings_;
    Jobs& jobs_;
    std::vector<Vec2> cut_;
};

}  // namespace

Draped drape(const Pattern& pattern, const SewnMesh& mesh, const FabricMaterial& material,
             const CookBody& body, const Stance& stance, const Placement& placement,
             const DrapeSettings& settings, Jobs& jobs) {
    return Draper(pattern, mesh, material, body, stance, settings, jobs).run(placement);
}

}  // namespace vfit
