#include "cook/drape/upper_edge.h"

#include <algorithm>
#include <cmath>

#include "geometry/section.h"

namespace vfit {

std::vector<uint32_t> upper_edge(std::span<const Vec3> places,
                                 const std::vector<std::vector<uint32_t>>& openings, float axis_z) {
    const std::vector<uint32_t>* best = nullptr;
    size_t about = 0;
    for (const auto& opening : openings) {
        std::vector<Vec2> seen;
        for (const uint32_t v : opening) seen.emplace_back(places[v].x, places[v].z);
        if (!encloses(seen, {0.0f, axis_z})) continue;
        ++about;
        if (!best || mean_height(places, opening) > mean_height(places, *best)) best = &opening;
    }
    std::vector<uint32_t> edge;
    if (best)
        edge = *best;
    else
        for (const auto& opening : openings) edge.insert(edge.end(), opening.begin(), opening.end());
    float top = -INFINITY, low = INFINITY;
    for (const uint32_t v : edge) top = std::max(top, places[v].y), low = std::min(low, places[v].y);
    // A waist may be lower in front, or be an arc in a panel that is still flat, but a slit, a fly or a hem
    // is no part of it.
    constexpr float kNearTop_m = 0.05f, kSlanted_m = 0.15f, kArc_m = 0.3f;
    if (best && top - low < (about > 1 ? kArc_m : kSlanted_m)) return edge;
    std::erase_if(edge, [&](uint32_t v) { return places[v].y < top - kNearTop_m; });
    return edge;
}

float mean_height(std::span<const Vec3> places, const std::vector<uint32_t>& of) {
    float sum = 0.0f;
    for (const uint32_t v : of) sum += places[v].y;
    return sum / float(std::max<size_t>(of.size(), 1));
}

}  // namespace vfit
