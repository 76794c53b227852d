#include "cloth/contact/untangle.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

Vec3 unit(const Vec3& v) { return v / std::max(glm::length(v), 1e-12f); }

}  // namespace

std::span<const uint32_t> Untangle::move(std::span<const TrianglePair> crossed,
                                         std::span<const uint32_t> indices, std::span<const uint8_t> is_fixed,
                                         float step_m, std::span<Vec3> places) {
    vertices_.clear();
    ways_.resize(places.size(), Vec3(0.0f));
    for (const auto& [a, b] : crossed) {
        const uint32_t first[3] = {indices[3 * a], indices[3 * a + 1], indices[3 * a + 2]},
                       second[3] = {indices[3 * b], indices[3 * b + 1], indices[3 * b + 2]};
        shorten(first, second, places);
        shorten(second, first, places);
        vertices_.insert(vertices_.end(), first, first + 3);
        vertices_.insert(vertices_.end(), second, second + 3);
    }
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (const uint32_t v : vertices_) {
        if (!is_fixed[v]) places[v] += ways_[v] * (step_m / std::sqrt(1.0f + glm::dot(ways_[v], ways_[v])));
        ways_[v] = Vec3(0.0f);
    }
    return vertices_;
}

/// Of the sides of `own` that go through `other`; the triangle beyond a side does its own part.
void Untangle::shorten(const uint32_t (&own)[3], const uint32_t (&other)[3], std::span<const Vec3> places) {
    constexpr float kParallel = 1e-4f, kGrazing = 0.2f;
    const auto normal_of = [&](const uint32_t(&t)[3]) {
        return glm::cross(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]);
    };
    const Vec3 across = normal_of(other), normal = unit(across), own_normal = unit(normal_of(own));
    Vec3 line = glm::cross(own_normal, normal);
    if (glm::length(line) < kParallel) return;
    line = unit(line);
    for (size_t e = 0; e < 3; ++e) {
        const uint32_t from = own[e], to = own[(e + 1) % 3];
        const float above_from = glm::dot(places[from] - places[other[0]], normal),
                    above_to = glm::dot(places[to] - places[other[0]], normal);
        if (above_from * above_to >= 0.0f) continue;
        const float at = above_from / (above_from - above_to);
        const Vec3 off = glm::mix(places[from], places[to], at) - places[other[0]];
        const float size2 = std::max(glm::dot(across, across), 1e-20f);
        const float second = glm::dot(glm::cross(off, places[other[2]] - places[other[0]]), across) / size2;
        const float third = glm::dot(glm::cross(places[other[1]] - places[other[0]], off), across) / size2;
        const float first = 1.0f - second - third;
        if (std::min({first, second, third}) < 0.0f) continue;
        const Vec3 along = unit(places[to] - places[from]);
        const Vec3 inwards = glm::cross(own_normal, along);
        const Vec3 contour = glm::dot(line, inwards) > 0.0f ? line : -line;
        const float upright = glm::dot(along, normal),
                    steep = std::copysign(std::max(std::abs(upright), kGrazing), upright);
        const Vec3 way = contour - normal * (2.0f * glm::dot(along, contour) / steep);  // their equation 2
        ways_[from] += (1.0f - at) * way, ways_[to] += at * way;
        ways_[other[0]] -= first * way, ways_[other[1]] -= second * way, ways_[other[2]] -= third * way;
    }
}

}  // namespace vfit
