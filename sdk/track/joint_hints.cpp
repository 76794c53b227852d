#include "track/joint_hints.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr int kSide = JointMaps::kSide;
// How far a right hint lies from the joint as this network defines it; chosen, as are the shares below, so that
// right hints help and wrong ones do little (tests/contract/hints_test.cpp).
constexpr float kSigma_m = 0.08f;
constexpr float kSigma = kSigma_m / (0.5f * CropView::kSide_m);  // in crop coordinates, from -1 to 1
constexpr float kWrongHeat = 0.02f;  // share of cases in which the joint is not where the network's heat is
constexpr float kSurest = 0.98f;     // no hint is certain
constexpr float kGrow = 0.25f;       // of the box's size

float place_of(int cell) { return (float(cell) + 0.5f) / (0.5f * kSide) - 1.0f; }

void apply(const Vec2& place, float confidence, float* logits) {
    const float highest = *std::max_element(logits, logits + JointMaps::kCells);
    float sum = 0.0f;
    for (int i = 0; i < JointMaps::kCells; ++i) sum += std::exp(logits[i] - highest);
    const float anywhere = 0.25f * (1.0f - confidence);  // density over the crop, whose area is 4
    const float near = confidence / (2.0f * kPi * kSigma * kSigma);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            float& logit = logits[y * kSide + x];
            const float heat = std::exp(logit - highest) / sum;
            const float dx = (place_of(x) - place.x) / kSigma, dy = (place_of(y) - place.y) / kSigma;
            const float believed = (1.0f - kWrongHeat) * heat + kWrongHeat / JointMaps::kCells;
            logit = std::log(believed * (anywhere + near * std::exp(-0.5f * (dx * dx + dy * dy))));
        }
}

}  // namespace

void apply_hints(std::span<const JointHint> hints, const CropView& view, bool away, JointMaps& maps) {
    for (const JointHint& hint : hints) {
        const Vec2 from_centre = Vec2(hint.x, hint.y) - view.centre;
        const float half = 0.5f * CropView::kPixels;
        const Vec2 place(glm::dot(from_centre, view.right) / glm::dot(view.right, view.right) / half,
                         glm::dot(from_centre, view.down) / glm::dot(view.down, view.down) / half);
        const float confidence = std::min(hint.confidence, kSurest);
        if (confidence <= 0.0f || !(std::abs(place.x) <= 1.0f && std::abs(place.y) <= 1.0f)) continue;
        const int joint = away ? mirrored_joint(hint.joint) : hint.joint;
        apply(place, confidence, maps.heat.data() + size_t(joint) * JointMaps::kCells);
    }
}

bool near_box(const JointHint& hint, const PixelBox& box) {
    if (box.empty()) return true;  // anywhere
    const float more = kGrow * float(std::max(box.x1 - box.x0, box.y1 - box.y0));
    return hint.x >= float(box.x0) - more && hint.x <= float(box.x1) + more &&
           hint.y >= float(box.y0) - more && hint.y <= float(box.y1) + more;
}

}  // namespace vfit
