#include "fit/fit_residuals.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/wipe.h"

namespace vfit {

namespace {

constexpr float kFacingCosine = 0.5f;  // of a normal to the line of sight: depth says how far out the surface is
constexpr float kEdgeCosine = 0.30f;    // the vertex is on the body's own outline
constexpr float kFarthest_m = 0.08f;   // beyond it is something else: an arm before the trunk, the wall
constexpr float kTooNear_m = 0.25f;
constexpr int kRimReach = 16;  // pixels
constexpr uint32_t kFewestReadings = 20;  // of a zone: fewer are chance
constexpr float kFrontYaw_rad = 0.6f, kSideFrom_rad = 1.05f, kSideTo_rad = 2.1f;

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

/// Mean of the person's readings about a pixel; 0 where most are not theirs.
float depth_about(const DepthImage& image, uint8_t user, int x, int y) {
    float sum = 0.0f;
    int count = 0;
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) {
            const size_t i = image.index(uint32_t(u), uint32_t(v));
            if (image.users[i] != user || image.depth[i] == 0) continue;
            sum += image.metres(i);
            ++count;
        }
    return count >= 5 ? sum / float(count) : 0.0f;
}

}  // namespace

FitViewKind view_kind_of(const FitBody& body) {
    const Vec3 ahead = body.bone_turns()[VFIT_BONE_HIPS] * Vec3(0, 0, 1);
    const float yaw = std::abs(std::atan2(ahead.x, -ahead.z));
    return yaw <= kFrontYaw_rad                        ? FitViewKind::kFront
           : yaw >= kSideFrom_rad && yaw <= kSideTo_rad ? FitViewKind::kSide
                                                        : FitViewKind::kOther;
}

// Each next middle is the vertex farthest from those before it; the trunk's distances count double.
FitZones::FitZones(const FitModel& model) : of_vertex_(model.vertex_count()) {
    constexpr float kTrunkScale = 2.0f, kOpposite_m = 0.2f, kOtherLimb_m = 0.3f;
    FitBody body(model);
    body.place(FitState{});
    const auto& positions = body.positions();
    std::vector<float> distance(positions.size(), 1e9f);
    uint32_t middle = 0;
    for (int zone = 0; zone < kCount; ++zone) {
        const int limb = model.vertices()[middle].limb;
        for (uint32_t v = 0; v < positions.size(); ++v) {
            // Opposite sides of a limb are no neighbours, nor are two limbs.
            const float opposite = 0.5f - 0.5f * glm::dot(body.normals()[v], body.normals()[middle]);
            const float apart = (model.vertices()[v].limb == 0 ? kTrunkScale : 1.0f) *
                                    glm::distance(positions[v], positions[middle]) +
                                kOpposite_m * opposite + (model.vertices()[v].limb == limb ? 0.0f : kOtherLimb_m);
            if (apart < distance[v]) distance[v] = apart, of_vertex_[v] = uint8_t(zone);
        }
        middle = uint32_t(std::max_element(distance.begin(), distance.end()) - distance.begin());
    }
}

FitResiduals::FitResiduals(const FitModel& model) : model_(model), zones_(model), outwards_(model.vertex_count()) {
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

void FitResiduals::reset() {
    for (auto& sums : sums_) wipe(std::span(sums));
    frames_ = {};
}

float FitResiduals::outwards(uint32_t vertex, const FitShape& shape) const {
    float sum = 0.0f;
    for (size_t s = 0; s < size_t(kFitShapes); ++s) sum += outwards_[vertex][s] * shape[s];
    return sum;
}

FitResiduals::Zones FitResiduals::means_m(FitViewKind view, FitSeen seen, const FitShape& shape) const {
    std::array<double, FitZones::kCount> distance{};
    std::array<uint32_t, FitZones::kCount> count{};
    for (uint32_t v = 0; v < model_.vertex_count(); ++v) {
        const Sum& one = sums(view, seen)[v];
        if (one.count == 0) continue;
        const auto zone = size_t(zones_.of(v));
        distance[zone] += double(one.distance) - double(one.count) * double(outwards(v, shape));
        count[zone] += one.count;
    }
    Zones means{};
    for (size_t zone = 0; zone < means.size(); ++zone)
        if (count[zone] >= kFewestReadings) means[zone] = float(distance[zone] / count[zone]);
    return means;
}

float FitResiduals::roughness_m(FitViewKind view, int region, const FitShape& shape) const {
    const uint32_t fewest = std::max(1u, frames_[size_t(view)] / 2);
    const Zones means = means_m(view, FitSeen::kFacing, shape);
    double squares = 0.0;
    uint32_t count = 0;
    for (uint32_t v = 0; v < model_.vertex_count(); ++v) {
        const Sum& one = sums(view, FitSeen::kFacing)[v];
        if (one.count < fewest || region_of(model_.vertices()[v]) != region) continue;
        const float apart = one.distance / float(one.count) - outwards(v, shape) - means[size_t(zones_.of(v))];
        squares += double(apart * apart);
        ++count;
    }
    return count ? float(std::sqrt(squares / count)) : 0.0f;
}

void FitResiduals::add(const DepthImage& image, uint8_t user, const FitBody& body, const FitShape& shape) {
    const FitViewKind view = view_kind_of(body);
    if (view == FitViewKind::kOther) return;
    ++frames_[size_t(view)];
    auto& facing = sums(view, FitSeen::kFacing);
    auto& rim = sums(view, FitSeen::kRim);
    const int width = int(image.width()), height = int(image.height());
    const auto belongs = [&](int x, int y) { return image.users[image.index(uint32_t(x), uint32_t(y))] == user; };
    for (uint32_t v = 0; v < body.model().vertex_count(); ++v) {
        const Vec3 &p = body.positions()[v], &n = body.normals()[v];
        if (p.z < kTooNear_m || body.model().vertices()[v].bridged) continue;
        const Vec2 at = image.camera.project(p);
        const int x = int(std::lround(at.x)), y = int(std::lround(at.y));
        if (x < 1 || y < 1 || x >= width - 1 || y >= height - 1) continue;
        const float towards = -glm::dot(n, glm::normalize(p));
        if (towards > kFacingCosine) {
            const float z = depth_about(image, user, x, y);
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
                const int u = int(std::lround(at.x + float(i) * step.x)), w = int(std::lround(at.y + float(i) * step.y));
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
