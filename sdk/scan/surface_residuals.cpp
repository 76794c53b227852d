#include "scan/surface_residuals.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/wipe.h"

namespace vfit {

namespace {

constexpr float kFacingCosine =
    0.5f;  // of a normal to the line of sight: depth says how far out the surface is
constexpr float kEdgeCosine = 0.30f;  // the vertex is on the body's own outline
constexpr float kFarthest_m = 0.06f;  // beyond it is something else: an arm before the trunk, the wall
constexpr float kTooNear_m = 0.25f;
constexpr int kRimReach = 16;  // pixels
constexpr uint32_t kFewestShare =
    4;  // a vertex that was seen in less than a fourth of the frames was seen by chance

/// Trunk, arms or legs; -1: head, hands and feet, which clothes leave bare.
int region_of(const FitModel::Vertex& vertex) {
    switch (vertex.influences[0].bone) {
        case VFIT_BONE_NECK:
        case VFIT_BONE_HEAD:
        case VFIT_BONE_LEFT_HAND:
        case VFIT_BONE_RIGHT_HAND:
        case VFIT_BONE_LEFT_FOOT:
        case VFIT_BONE_RIGHT_FOOT: return -1;
        default: return vertex.limb == 0 ? 0 : vertex.limb <= 2 ? 1 : 2;
    }
}

/// Mean of the person's readings about a pixel that are of that surface; 0 where most are not.
float depth_about(const DepthImage& image, uint8_t user, int x, int y, float z) {
    float sum = 0.0f;
    int count = 0;
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) {
            const size_t i = image.index(uint32_t(u), uint32_t(v));
            if (image.users[i] != user || image.depth[i] == 0) continue;
            if (std::abs(image.metres(i) - z) > kFarthest_m) continue;
            sum += image.metres(i);
            ++count;
        }
    return count >= 5 ? sum / float(count) : 0.0f;
}

}  // namespace

SurfaceResiduals::SurfaceResiduals(const FitModel& model)
    : model_(model), zones_(model), outwards_(model.vertex_count()) {
    for (uint32_t v = 0; v < model.vertex_count(); ++v) {
        // In the frame of its first bone, which carries it; normals hardly turn with shape.
        const FitPoint& place = model.places()[size_t(v) * kFitInfluences];
        const Vec3& n = model.normals()[size_t(v) * kFitInfluences];
        for (size_t s = 0; s < size_t(kFitShapes); ++s)
            outwards_[v][s] = n.x * place.fields[s] + n.y * place.fields[kFitShapeLanes + s] +
                              n.z * place.fields[2 * kFitShapeLanes + s];
    }
    for (auto& sums : sums_) sums.resize(model.vertex_count());
}

void SurfaceResiduals::reset() {
    for (auto& sums : sums_) wipe(std::span(sums));
    frames_ = {};
}

float SurfaceResiduals::outwards(uint32_t vertex, const FitShape& shape) const {
    float sum = 0.0f;
    for (size_t s = 0; s < size_t(kFitShapes); ++s) sum += outwards_[vertex][s] * shape[s];
    return sum;
}

float SurfaceResiduals::mean_m(ViewKind view, Seen seen, uint32_t vertex, const FitShape& shape) const {
    const Sum& one = sums(view, seen)[vertex];
    if (one.count < std::max(1u, frames_[size_t(view)] / kFewestShare)) return std::nanf("");
    return one.distance / float(one.count) - outwards(vertex, shape);
}

SurfaceResiduals::Zones SurfaceResiduals::means_m(ViewKind view, Seen seen, const FitShape& shape) const {
    std::array<double, BodyZones::kCount> distance{};
    std::array<uint32_t, BodyZones::kCount> count{};
    for (uint32_t v = 0; v < model_.vertex_count(); ++v) {
        const float mean = zones_.of(v) < 0 ? std::nanf("") : mean_m(view, seen, v, shape);
        if (std::isnan(mean)) continue;
        distance[size_t(zones_.of(v))] += double(mean);
        ++count[size_t(zones_.of(v))];
    }
    Zones means;
    for (size_t zone = 0; zone < means.size(); ++zone)
        means[zone] = count[zone] ? float(distance[zone] / count[zone]) : std::nanf("");
    return means;
}

float SurfaceResiduals::roughness_m(ViewKind view, int region, const FitShape& shape) const {
    const Zones means = means_m(view, Seen::kFacing, shape);
    double squares = 0.0;
    uint32_t count = 0;
    for (uint32_t v = 0; v < model_.vertex_count(); ++v) {
        if (region_of(model_.vertices()[v]) != region) continue;
        const float apart = mean_m(view, Seen::kFacing, v, shape) - means[size_t(zones_.of(v))];
        if (std::isnan(apart)) continue;
        squares += double(apart * apart);
        ++count;
    }
    return count ? float(std::sqrt(squares / count)) : std::nanf("");
}

void SurfaceResiduals::add(const DepthImage& image, uint8_t user, const BodyFit& fit) {
    const FitBody& body = fit.body();
    const FitShape& shape = fit.output().pose.shape;
    const ViewKind view =
        view_kind_of(facing_rad(image.camera, body.bone_turns()[VFIT_BONE_HIPS] * Vec3(0, 0, 1)));
    if (view == ViewKind::kOther) return;
    ++frames_[size_t(view)];
    auto& facing = sums(view, Seen::kFacing);
    auto& rim = sums(view, Seen::kRim);
    const int width = int(image.width()), height = int(image.height());
    const auto belongs = [&](int x, int y) {
        return image.users[image.index(uint32_t(x), uint32_t(y))] == user;
    };
    for (uint32_t v = 0; v < body.model().vertex_count(); ++v) {
        const Vec3 &p = body.positions()[v], &n = body.normals()[v];
        if (p.z < kTooNear_m || body.model().vertices()[v].bridged || fit.hidden(v)) continue;
        const Vec2 at = image.camera.project(p);
        const int x = int(std::lround(at.x)), y = int(std::lround(at.y));
        if (x < 1 || y < 1 || x >= width - 1 || y >= height - 1) continue;
        const float towards = -glm::dot(n, glm::normalize(p));
        if (towards > kFacingCosine) {
            const float z = depth_about(image, user, x, y, p.z);
            if (z == 0.0f) continue;
            const float out = (z / p.z - 1.0f) * glm::dot(p, n);
            if (std::abs(out) > kFarthest_m) continue;
            facing[v].distance += out + outwards(v, shape);
            ++facing[v].count;
        } else if (std::abs(towards) < kEdgeCosine) {
            // Along the picture's outward direction to where the person ends.
            const Vec2 tip = image.camera.project(p + 0.01f * n);
            Vec2 step = tip - at;
            const float length = glm::length(step);
            if (length < 1e-3f) continue;
            step /= length;
            int last = -kRimReach - 1;
            bool border = false;
            for (int i = -kRimReach; i <= kRimReach; ++i) {
                const int u = int(std::lround(at.x + float(i) * step.x)),
                          w = int(std::lround(at.y + float(i) * step.y));
                if (u < 0 || w < 0 || u >= width || w >= height) break;
                if (belongs(u, w))
                    last = i;
                else if (last >= -kRimReach && i - last > 2) {
                    border = true;
                    break;
                }
            }
            if (!border) continue;
            const float out = (float(last) + 0.5f) * p.z / image.camera.fx;
            if (std::abs(out) > kFarthest_m) continue;
            rim[v].distance += out + outwards(v, shape);
            ++rim[v].count;
        }
    }
}

}  // namespace vfit
