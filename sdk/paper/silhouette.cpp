#include "paper/silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vfit {

namespace {

// Reach of the 5 x 5 Gaussian, in pixels: a step of depth is spread over twice as many, and depth that close
// to the edge of the mask is partly the background's.
constexpr int kKernelReach = 2;
constexpr int kSpan = 2 * kKernelReach;

int nearest(float x) {
    constexpr float kFarOutside = 1e6f;
    return x > -kFarOutside && x < kFarOutside ? int(std::floor(x + 0.5f)) : -int(kFarOutside);
}

}  // namespace

Pixel nearest_pixel(Vec2 place) { return {nearest(place.x), nearest(place.y)}; }

Walk walk_to_contour(const FilteredDepth& depth, Vec2 start, Vec2 direction) {
    Walk walk;
    const float longest = std::max(std::abs(direction.x), std::abs(direction.y));
    const Pixel first = nearest_pixel(start);
    if (!(longest > 0.0f) || !depth.inside(first.x, first.y)) return walk;
    walk.inside = true;

    const Vec2 origin(float(first.x), float(first.y));
    const Vec2 step = direction / longest;
    const auto end_at = [&](float steps) {
        walk.edge = origin + step * steps;
        walk.length_px = std::max(0.0f, glm::dot(walk.edge - start, glm::normalize(step)));
    };
    const auto pixel = [&](int i) { return nearest_pixel(origin + step * float(i)); };
    const auto in_image = [&](Pixel p) {
        return p.x >= 0 && p.y >= 0 && p.x < int(depth.width) && p.y < int(depth.height);
    };

    // The filter has spread the jump over its kernel: it stood where the depth changes fastest. Near the edge
    // of the mask it is the filter's background that jumps, and the edge is the contour.
    const auto edge_of_jump = [&](int found) {
        float steepest = -1.0f, place = 0.0f;
        for (int k = std::max(1, found - kSpan + 1); k <= found + kKernelReach; ++k) {
            const auto a = pixel(k - 1), b = pixel(k);
            if (!depth.inside(b.x, b.y)) return float(k) - 0.5f;
            const float change = std::abs(depth.at(b.x, b.y) - depth.at(a.x, a.y));
            if (change > steepest) {
                steepest = change;
                place = float(k) - 0.5f;
            }
        }
        return place;
    };

    std::array<float, kSpan> before;  // depth of the last steps, a ring
    before.fill(depth.at(first.x, first.y));
    for (int i = 1;; ++i) {
        const auto p = pixel(i);
        if (!in_image(p)) {
            walk.border = true;
            end_at(float(i) - 0.5f);
            return walk;
        }
        if (!depth.inside(p.x, p.y)) {
            end_at(float(i) - 0.5f);
            return walk;
        }
        const float here = depth.at(p.x, p.y);
        float& oldest = before[size_t(i) % kSpan];
        if (std::abs(here - oldest) > kContourJump_m) {
            end_at(edge_of_jump(i));
            return walk;
        }
        oldest = here;
    }
}

FrontalPlane::FrontalPlane(const Camera& camera, const Vec3& through)
    : camera_(camera), up_(camera.floor_normal) {
    const Vec3 view(0, 0, 1);
    forward_ = view - up_ * glm::dot(view, up_);
    // A camera that looks straight down has no level view direction: its own plane serves.
    const bool level = glm::length(forward_) > 0.1f;
    forward_ = level ? glm::normalize(forward_) : view;
    right_ = level ? glm::normalize(glm::cross(forward_, up_)) : Vec3(1, 0, 0);
    distance_ = glm::dot(forward_, through);
}

Vec3 FrontalPlane::point(Vec2 pixel) const {
    const Vec3 ray = camera_.unproject(pixel.x, pixel.y, 1.0f);
    return ray * (distance_ / glm::dot(forward_, ray));
}

float FrontalPlane::elevation_rad(Vec2 pixel) const {
    const Vec3 ray = glm::normalize(camera_.unproject(pixel.x, pixel.y, 1.0f));
    return std::asin(std::clamp(glm::dot(ray, up_), -1.0f, 1.0f));
}

FrontalPlane::Reach FrontalPlane::reach(const FilteredDepth& depth, const Vec3& from,
                                        const Vec3& direction) const {
    Reach reach;
    if (!(from.z > 0.0f)) return reach;
    constexpr float kAhead_m = 0.05f;  // far enough to tell the direction in the image
    const Vec2 start = camera_.project(from);
    const Vec2 ahead = camera_.project(from + direction * kAhead_m);
    static_cast<Walk&>(reach) = walk_to_contour(depth, start, ahead - start);
    if (reach.inside) reach.point = point(reach.edge);
    return reach;
}

}  // namespace vfit
