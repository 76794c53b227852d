#include "fit/fit_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace vfit {

namespace {

constexpr float kGate_m2 = 0.06f;        // of the matching score: farther points have no match
constexpr float kLeastAgreement = 0.2f;  // cosine between the normals of a match
// Points this far aside of their vertex are not covered by the model: half the side of its triangles, and
// some.
constexpr float kBeside_m = 0.035f;
constexpr int kFarthestCells = 16;  // from the outline: about 20 cm
constexpr float kHiding_m = 0.05f;  // a reading this far before a vertex hides it
constexpr float kNearest_m = 0.25f;
constexpr float kRimCosine =
    0.35f;  // of a normal to the line of sight: the vertex is on the model's own outline
constexpr int kOutwardCells = 8;      // about 10 cm
constexpr float kSameLimb_m = 0.12f;  // in depth
// Beyond the person's last cell, without a reading before the background begins: wider than sensors lose of
// an outline, not so wide that nothing is behind.
constexpr float kHidden_m = 0.025f, kHiddenReach_m = 0.20f;
// Of the weight of other joints: under clothes the network takes the trousers' crotch for the body's.
constexpr float kHipShare = 0.1f;

bool about_the_hips(int joint) {
    return joint == VFIT_JOINT_LEFT_HIP || joint == VFIT_JOINT_RIGHT_HIP || joint == VFIT_JOINT_PELVIS;
}

float robust(float residual, float width) {
    const float ratio = 1.0f / (1.0f + residual * residual / (width * width));
    return ratio * ratio;
}

/// The person's cell nearest to that one, by rings about it.
bool nearest_person_cell(const FitView& view, int x, int y, int& found_x, int& found_y) {
    int best = (kFarthestCells + 1) * (kFarthestCells + 1);
    const int limit = best;
    const auto look = [&](int cx, int cy) {
        if (!view.inside(cx, cy) || view.cell(cx, cy) != FitCell::kPerson) return;
        const int squared = (cx - x) * (cx - x) + (cy - y) * (cy - y);
        if (squared < best) best = squared, found_x = cx, found_y = cy;
    };
    for (int r = 1; r <= kFarthestCells && r * r < best; ++r)
        for (int i = -r; i <= r; ++i) {
            look(x + i, y - r), look(x + i, y + r);
            look(x - r, y + i), look(x + r, y + i);
        }
    return best < limit;
}

/// How far outwards of a rim vertex the person goes on uncovered by the model, in cells along `step`.
float uncovered_cells(const FitView& view, const FitRaster& raster, const Vec2& from, const Vec2& step,
                      float depth_m) {
    float last = 0.0f;
    for (int i = 1; i <= kOutwardCells; ++i) {
        const int x = int(std::lround(from.x + float(i) * step.x)),
                  y = int(std::lround(from.y + float(i) * step.y));
        if (i == 1 && view.inside(x, y) && raster.depth(view, x, y) > 0.0f)
            continue;  // the vertex's own edge
        if (!view.inside(x, y) || view.cell(x, y) != FitCell::kPerson || raster.depth(view, x, y) > 0.0f ||
            std::abs(view.depth(x, y) - depth_m) > kSameLimb_m)
            break;
        last = float(i);
    }
    return last;
}

/// Whether the outline is not seen: from the person's cell on along `step` there is no reading for a while,
/// and then there is the background.
bool hides_outline(const FitView& view, const Vec2& from, const Vec2& step, float cell_m) {
    for (int i = 1; float(i) * cell_m < kHiddenReach_m; ++i) {
        const int x = int(std::lround(from.x + float(i) * step.x)),
                  y = int(std::lround(from.y + float(i) * step.y));
        if (!view.inside(x, y)) return false;
        if (view.cell(x, y) != FitCell::kFree)
            return view.cell(x, y) == FitCell::kOther && float(i - 1) * cell_m > kHidden_m;
    }
    return false;
}

/// Of z |(x/z, y/z) - a ray| by the point, the ray's depth moving along; `unit` points from the ray to the
/// point.
Vec3 away_from_ray(const Vec2& unit, const Vec3& p) {
    return Vec3(unit.x, unit.y, -(unit.x * p.x + unit.y * p.y) / p.z);
}

}  // namespace

uint32_t add_depth_rows(const FitView& view, const FitBody& body, const FitRaster& raster,
                        const FitWeights& weights, FitTargets& targets, FitEquations& equations) {
    targets.clear();
    const uint32_t count = body.model().vertex_count();
    // About the hips: differences of squares lose fewer digits near the origin.
    const Vec3 origin = body.bone_places()[VFIT_BONE_HIPS];
    for (uint32_t v = 0; v < count; ++v)
        if (raster.visible(body, view, v)) targets.add(body.positions()[v] - origin, body.normals()[v], v);
    targets.finish();
    if (targets.count() == 0) return 0;

    const float depth_weight = weights.depth_share / (weights.depth_m * weights.depth_m);
    const float reach_weight = weights.reach_share / (weights.reach_m * weights.reach_m);
    uint32_t matched = 0;
    for (const FitDepthPoint& point : view.points()) {
        float score = 0.0f;
        const uint32_t v = nearest_target(targets, point.place - origin, point.normal, score);
        if (score > kGate_m2 || glm::dot(point.normal, body.normals()[v]) < kLeastAgreement) continue;
        ++matched;
        // Both normals: what is left of the difference of two points of one curved surface vanishes to second
        // order (Rusinkiewicz 2019).
        const Vec3 direction = glm::normalize(body.normals()[v] + point.normal);
        const Vec3 apart = point.place - body.positions()[v];
        const float residual = glm::dot(direction, apart);
        equations.add_vertex_row(v, direction, residual, depth_weight * robust(residual, weights.robust_m));
        if (body.model().vertices()[v].bridged) continue;
        const Vec3 aside = apart - residual * direction;
        const float distance = glm::length(aside);
        if (distance > kBeside_m)
            equations.add_vertex_row(v, aside / distance, distance - kBeside_m,
                                     reach_weight * robust(distance - kBeside_m, 2.0f * weights.robust_m));
    }
    return matched;
}

uint32_t add_outline_rows(const FitView& view, const FitBody& body, const FitRaster& raster,
                          const FitWeights& weights, FitEquations& equations) {
    const float weight = weights.outline_share / (weights.outline_m * weights.outline_m);
    const float cell_angle = view.ray(1.0f, 0.0f).x - view.ray(0.0f, 0.0f).x;
    const Vec3 head = body.joints()[VFIT_JOINT_HEAD], up = head - body.joints()[VFIT_JOINT_NECK];
    uint32_t rows = 0;
    for (uint32_t v = 0; v < body.model().vertex_count(); ++v) {
        const Vec3& p = body.positions()[v];
        if (p.z < kNearest_m) continue;
        const Vec2 at = view.project(p);
        if (!(std::abs(at.x) < 1e6f && std::abs(at.y) < 1e6f) || view.beyond_image(at)) continue;
        const int x = int(std::lround(at.x)), y = int(std::lround(at.y));
        if (!view.inside(x, y)) continue;  // farther than any row reaches
        const FitCell cell = view.cell(x, y);
        const float cell_m = p.z * cell_angle;
        if (cell == FitCell::kPerson) {
            if (body.model().vertices()[v].bridged) continue;
            const Vec3& n = body.normals()[v];
            const Vec3 look = glm::normalize(p), across = n - glm::dot(n, look) * look;
            if (std::abs(glm::dot(n, look)) > kRimCosine) continue;
            const Vec2 unit =
                glm::normalize(Vec2(across.x - p.x / p.z * across.z, across.y - p.y / p.z * across.z));
            const float beyond = cell_m * uncovered_cells(view, raster, at, unit, p.z);
            if (beyond == 0.0f) continue;
            equations.add_vertex_row(v, away_from_ray(unit, p), beyond,
                                     weight * robust(beyond, weights.robust_m));
            ++rows;
            continue;
        }
        if (cell == FitCell::kOther && view.depth(x, y) < p.z - kHiding_m) continue;
        int found_x = 0, found_y = 0;
        if (!nearest_person_cell(view, x, y, found_x, found_y)) continue;
        const Vec3 edge = view.ray(float(found_x), float(found_y));
        const Vec2 out(p.x / p.z - edge.x, p.y / p.z - edge.y);
        const float angle = glm::length(out);
        // Black hair gives no reading: the head may reach into it.
        if (cell == FitCell::kFree && glm::dot(p - head, up) > 0.0f &&
            hides_outline(view, Vec2(found_x, found_y), glm::normalize(at - Vec2(found_x, found_y)), cell_m))
            continue;
        // Half a cell belongs to the person's side.
        const float outside = p.z * angle - 0.5f * cell_m;
        if (outside <= 0.0f || angle < 1e-6f) continue;
        equations.add_vertex_row(v, away_from_ray(out / angle, p), -outside,
                                 weight * robust(outside, weights.robust_m));
        ++rows;
    }
    return rows;
}

void add_joint_rows(const FitJoints& joints, const FitBody& body, const FitWeights& weights,
                    FitEquations& equations) {
    const float weight = 1.0f / (weights.joint_m * weights.joint_m);
    for (int j = 0; j < kJointCount; ++j) {
        const FitJoint& seen = joints[size_t(j)];
        if (seen.confidence <= 0.0f) continue;
        const Vec3 apart = seen.place - body.joints()[size_t(j)];
        const float share = (about_the_hips(j) ? kHipShare : 1.0f) * seen.confidence * seen.confidence;
        const float w = share * weight * robust(glm::length(apart), weights.joint_robust_m);
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 direction(0.0f);
            direction[axis] = 1.0f;
            equations.add_joint_row(j, direction, apart[axis], w);
        }
    }
}

}  // namespace vfit
