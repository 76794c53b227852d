#include "geometry/triangle_layers.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vfit {

namespace {

constexpr float kThickness_m = 0.005f;  // half a triangle of the body: it stands in two or three layers
constexpr float kMostLayers = 1000.0f;  // of a body 5 m long
constexpr float kMargin_m = 1e-5f;      // a plane's own rounding

}  // namespace

TriangleLayers::TriangleLayers(std::span<const Vec3> positions, std::span<const uint32_t> indices,
                               const Vec3& origin, const Vec3& direction, float low, float high)
    : low_(low),
      high_(std::max(low, high)),
      thickness_(std::max(kThickness_m, (high_ - low_) / kMostLayers)) {
    if (!std::isfinite(high_ - low_)) fail(VFIT_ERROR_DATA, "the mesh is too large to be measured");
    std::vector<float> places;
    places.reserve(positions.size());
    for (const Vec3& p : positions) places.push_back(glm::dot(direction, p - origin));
    struct Reach {
        uint32_t triangle, from, to;  // layers, both included
    };
    std::vector<Reach> reaches;
    first_.assign(layer_of(high_) + 2, 0);
    for (uint32_t t = 0; t < indices.size(); t += 3) {
        const float a = places[indices[t]], b = places[indices[t + 1]], c = places[indices[t + 2]];
        const float least = std::min({a, b, c}), most = std::max({a, b, c});
        if (most + kMargin_m < low_ || least - kMargin_m > high_) continue;
        reaches.push_back({t, uint32_t(layer_of(least - kMargin_m)), uint32_t(layer_of(most + kMargin_m))});
        for (uint32_t layer = reaches.back().from; layer <= reaches.back().to; ++layer)
            first_[layer + 1] += 3;
    }
    for (size_t layer = 1; layer < first_.size(); ++layer) first_[layer] += first_[layer - 1];
    indices_.resize(first_.back());
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (const Reach& reach : reaches)
        for (uint32_t layer = reach.from; layer <= reach.to; ++layer)
            for (uint32_t k = 0; k < 3; ++k) indices_[next[layer]++] = indices[reach.triangle + k];
}

/// What lies beyond an end counts to the layer there, and what lies nowhere to the first.
size_t TriangleLayers::layer_of(float place) const {
    const float inside = place >= low_ ? std::min(place, high_) : low_;
    return size_t(std::min((inside - low_) / thickness_, kMostLayers));
}

std::span<const uint32_t> TriangleLayers::at(float place) const {
    const size_t layer = layer_of(place);
    return std::span(indices_).subspan(first_[layer], first_[layer + 1] - first_[layer]);
}

}  // namespace vfit
