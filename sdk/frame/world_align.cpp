#include "frame/world_align.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"

namespace vfit {

namespace {

constexpr size_t kFewest = 8;
constexpr float kTogether_m =
    0.3f;                         // distance of the farthest point from the mean; below, noise sets the yaw
constexpr float kStray_m = 0.1f;  // residual at which the weight has halved (Cauchy)
constexpr int kRounds = 20;
constexpr float kFarthest_m = 1000.0f;

/// Of the points, each by its weight.
Vec3 mean_of(std::span<const Vec3> points, std::span<const float> weights) {
    Vec3 sum(0.0f);
    float all = 0.0f;
    for (size_t i = 0; i < points.size(); ++i) sum += weights[i] * points[i], all += weights[i];
    return sum / all;
}

void require_apart(std::span<const Vec3> points) {
    const std::vector<float> alike(points.size(), 1.0f);
    const Vec3 mean = mean_of(points, alike);
    float farthest = 0.0f;
    for (const Vec3& p : points) farthest = std::max(farthest, std::hypot(p.x - mean.x, p.z - mean.z));
    if (!(farthest >= kTogether_m))
        fail(VFIT_ERROR_DATA, "all points lie within ", farthest, " m of their mean, at least ", kTogether_m,
             " m are needed: let a person walk about");
}

/// The turn about up that carries one set of points to the other: Horn (1987) in the plane.
WorldPlace place_of(std::span<const Vec3> here, std::span<const Vec3> there, std::span<const float> weights) {
    const Vec3 to = mean_of(here, weights), from = mean_of(there, weights);
    float along = 0.0f, across = 0.0f;
    for (size_t i = 0; i < here.size(); ++i) {
        const Vec3 a = there[i] - from, b = here[i] - to;
        along += weights[i] * (a.x * b.x + a.z * b.z);
        across += weights[i] * (a.z * b.x - a.x * b.z);
    }
    WorldPlace out;
    out.rotation = glm::angleAxis(std::atan2(across, along), Vec3(0, 1, 0));
    out.position = to - out.rotation * from;
    return out;
}

}  // namespace

WorldPlace align_worlds(std::span<const Vec3> here, std::span<const Vec3> there, float& rms_m) {
    if (here.size() < kFewest)
        fail(VFIT_ERROR_DATA, here.size(), " points: at least ", kFewest, " are needed");
    for (const std::span<const Vec3> points : {here, there})
        for (const Vec3& p : points)
            if (!(std::abs(p.x) <= kFarthest_m && std::abs(p.y) <= kFarthest_m &&
                  std::abs(p.z) <= kFarthest_m))
                fail(VFIT_ERROR_DATA, "a point is not finite, or further than ", kFarthest_m, " m away");
    require_apart(here), require_apart(there);
    std::vector<float> weights(here.size(), 1.0f);
    WorldPlace place;
    for (int round = 0; round < kRounds; ++round) {
        place = place_of(here, there, weights);
        float sum = 0.0f, all = 0.0f;
        for (size_t i = 0; i < here.size(); ++i) {
            const Vec3 off = place.point(there[i]) - here[i];
            const float squared = glm::dot(off, off);
            sum += weights[i] * squared, all += weights[i];
            weights[i] = 1.0f / (1.0f + squared / (kStray_m * kStray_m));
        }
        rms_m = std::sqrt(sum / all);
    }
    return place;
}

}  // namespace vfit
