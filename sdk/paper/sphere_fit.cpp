#include "paper/sphere_fit.h"

#include <algorithm>
#include <limits>

#include "paper/silhouette.h"

namespace vfit {

float fit_sphere(const FilteredDepth& depth, const Camera& camera, const Vec3& joint) {
    if (!(joint.z > 0.0f)) return 0.0f;
    const Vec2 pixel = camera.project(joint);
    const auto [x, y] = nearest_pixel(pixel);
    if (!depth.inside(x, y)) return 0.0f;

    constexpr float kNone = std::numeric_limits<float>::max();
    float radius = kNone;
    const float behind = joint.z - depth.at(x, y);
    if (behind > 0.0f) radius = behind;

    const struct {
        Vec2 direction;
        float metres_per_px;
    } directions[] = {{{-1, 0}, joint.z / camera.fx},
                      {{1, 0}, joint.z / camera.fx},
                      {{0, -1}, joint.z / camera.fy},
                      {{0, 1}, joint.z / camera.fy}};
    for (const auto& d : directions) {
        const Walk walk = walk_to_contour(depth, pixel, d.direction);
        if (walk.seen()) radius = std::min(radius, walk.length_px * d.metres_per_px);
    }
    return radius == kNone ? 0.0f : radius;
}

std::array<float, kPaperJointCount> fit_spheres(const FilteredDepth& depth, const Camera& camera,
                                                const Body& body) {
    std::array<float, kPaperJointCount> radii{};
    for (int joint = 0; joint < kPaperJointCount; ++joint)
        if (body.has(joint)) radii[size_t(joint)] = fit_sphere(depth, camera, body.at(joint));
    return radii;
}

}  // namespace vfit
