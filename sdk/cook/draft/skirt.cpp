// The A-line skirt: a cone from the waist over the hips, flared further below them.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cook/draft/blocks.h"
#include "core/error.h"

namespace vfit {

namespace {

/// Half of a skirt's front or back.
CutLine skirt_half(const std::vector<float>& waist_m, float hip, float hip_depth, float depth, float flare) {
    const float waist = std::accumulate(waist_m.begin(), waist_m.end(), 0.0f);
    // A cone unrolled: waist and hips are arcs about one centre above the middle, half an angle wide on each
    // side.
    const float angle = (hip - waist) / hip_depth;
    constexpr float kLeastAngle = 0.03f;  // 2 degrees: the waist would else be no arc
    if (angle < kLeastAngle)
        fail(VFIT_ERROR_DATA, "the skirt's hips are no wider than its waist: \"skirt.hip_ease_m\"");
    const float radius = waist / angle;
    const auto at = [&](float r, float a) { return Vec2(r * std::sin(a), radius - r * std::cos(a)); };
    const float side_angle = angle + std::atan(flare);
    if (side_angle > 1.2f)
        fail(VFIT_ERROR_DATA, "the skirt is wider than it can be cut in one piece: \"skirt.flare\"");
    const Vec2 hip_side = at(radius + hip_depth, angle);
    const Vec2 corner = hip_side + (depth - hip_depth) * Vec2(std::sin(side_angle), -std::cos(side_angle));
    const Vec2 middle(0.0f, -depth);
    // Square to the middle and to the side seam.
    const float reach = 0.36f * glm::distance(middle, corner);
    CutLine line(middle);
    line.cubic(middle + Vec2(reach, 0.0f), corner - reach * Vec2(std::cos(side_angle), std::sin(side_angle)),
               corner, "hem");
    line.line(hip_side, "side skirt").line(at(radius, angle), "side hip");
    float left = waist;
    for (size_t i = waist_m.size(); i-- > 0;) {
        left = i == 0 ? 0.0f : left - waist_m[i];
        line.arc(radius, false, at(radius, left / radius), "waist " + std::to_string(i + 1));
    }
    return line;
}

}  // namespace

SkirtBlock draft_skirt(const DraftMeasures& body, const SkirtDesign& design,
                       const std::vector<float>& front_waist_m, const std::vector<float>& back_waist_m) {
    const float hip = 0.25f * (body.hip + design.hip_ease_m), hip_depth = body.hip_depth();
    const float depth = body.depth(design.hem);
    if (depth < hip_depth + 0.05f) fail(VFIT_ERROR_DATA, "the skirt ends at the hips: \"skirt.hem\"");
    SkirtBlock block;
    block.front = skirt_half(front_waist_m, hip, hip_depth, depth, design.flare);
    block.back = skirt_half(back_waist_m, hip, hip_depth, depth, design.flare);
    for (int piece = 0; piece < 2; ++piece) block.girths.push_back({"hip_girth_m", 2.0f * hip});
    return block;
}

}  // namespace vfit
