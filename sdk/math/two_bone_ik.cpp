#include "math/two_bone_ik.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kLeastDistanceM = 1e-5f;

Vec3 any_square_to(const Vec3& n) {
    return glm::normalize(glm::cross(n, std::abs(n.x) < 0.7f ? Vec3(1, 0, 0) : Vec3(0, 0, 1)));
}

/// Distances up to (1 - softness) of the length stay; those beyond approach the length without reaching it.
float ease_reach(float distance, float length, float softness) {
    const float zone = softness * length;
    const float start = length - zone;
    if (distance <= start) return distance;
    if (zone <= 0.0f) return length;
    return start + zone * (1.0f - std::exp(-(distance - start) / zone));
}

}  // namespace

TwoBoneSolution solve_two_bone(const Vec3& root, float upper, float lower, const Vec3& goal, const Vec3& pole,
                               float softness) {
    const Vec3 to_goal = goal - root;
    const float distance = glm::length(to_goal);
    const Vec3 n = distance > kLeastDistanceM ? to_goal / distance : Vec3(0, -1, 0);
    const float reach = std::clamp(ease_reach(distance, upper + lower, softness),
                                   std::max(std::abs(upper - lower), kLeastDistanceM), upper + lower);

    const float along = (upper * upper + reach * reach - lower * lower) / (2.0f * reach);
    const float radius = std::sqrt(std::max(0.0f, upper * upper - along * along));
    Vec3 side = pole - glm::dot(pole, n) * n;
    const float side_length = glm::length(side);
    side = side_length > 1e-6f ? side / side_length : any_square_to(n);

    return {root + along * n + radius * side, root + reach * n};
}

}  // namespace vfit
