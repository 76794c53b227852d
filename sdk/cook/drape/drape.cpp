#include "cook/drape/drape.h"

#include <algorithm>
#include <cmath>

#include "cloth/cloth.h"
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
constexpr float kStage_m = 0.02f;  // by which the widest seams close in a stage
constexpr int kFramesAStage = 3, kFramesToClose = 180;

/// Corners of the triangles in flat cloth, one an index.
std::vector<Vec2> cut_of(const std::vector<uint32_t>& panel_indices, const std::vector<Vec2>& flat) {
    std::vector<Vec2> cut;
    for (const uint32_t v : panel_indices) cut.push_back(flat[v]);
    return cut;
}

class Draper {
public:
    Draper(const Pattern& pattern, const SewnMesh& mesh, const FabricMaterial& material,
           const DrapeBody& body, const DrapeSettings& settings, Jobs& jobs)
        : pattern_(pattern),
          mesh_(mesh),
          material_(material),
          body_(body),
          settings_(settings),
          jobs_(jobs),
          cut_(cut_of(mesh.panel_indices, mesh.flat())) {}

    Draped run(const Placement& placement) {
        const Stopwatch watch;
        std::vector<Vec3> places = placement.places;
        look("placed", places);
        const float widest = close_seams(places);
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
        const Band band = band_of(placement, one);
        Draped out =
            settle({mesh_.sewn_indices, cut_, &material_}, std::move(one), band, body_, of_sewn, jobs_);
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
    float close_seams(std::vector<Vec3>& places) {
        const std::vector<uint8_t> all(places.size(), 1);
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
            Cloth cloth(std::make_shared<const Fabric>(std::move(data)), settings, places);
            const uint32_t skin = cloth.add_mesh(body_.positions.size(), body_.indices, but_fingers(body_));
            for (int frame = 0; frame < (last ? kFramesToClose : kFramesAStage); ++frame) {
                cloth.move_mesh(skin, body_.positions);
                cloth.step(kFrame_s, places, {}, jobs_);
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

    Band band_of(const Placement& placement, const std::vector<Vec3>& sewn) const {
        Band band;
        band.of.assign(sewn.size(), 0);
        float height = 0.0f, count = 0.0f;
        for (const EdgeName& edge : placement.band)
            for (const uint32_t v : mesh_.panels[edge.panel].edge_vertices[edge.edge])
                band.of[mesh_.sewn_of[mesh_.first_vertex[edge.panel] + v]] = 1;
        for (uint32_t v = 0; v < sewn.size(); ++v)
            if (band.of[v]) height += sewn[v].y, count += 1.0f;
        if (count > 0.0f) band.lowered_m = height / count - placement.band_m;
        return band;
    }

    const Pattern& pattern_;
    const SewnMesh& mesh_;
    const FabricMaterial& material_;
    const DrapeBody& body_;
    const DrapeSettings& settings_;
    Jobs& jobs_;
    std::vector<Vec2> cut_;
};

}  // namespace

Draped drape(const Pattern& pattern, const SewnMesh& mesh, const FabricMaterial& material,
             const DrapeBody& body, const Placement& placement, const DrapeSettings& settings, Jobs& jobs) {
    return Draper(pattern, mesh, material, body, settings, jobs).run(placement);
}

}  // namespace vfit
