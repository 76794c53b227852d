#include "track/joint_hints.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// How far a right hint lies from the joint as this network defines it; chosen, as are the shares below, so
// that right hints help and wrong ones do little (tests/contract/hints_test.cpp).
constexpr float kSigma_m = 0.045f;
constexpr float kSigma = kSigma_m / (0.5f * CropView::kSide_m);  // in crop coordinates, from -1 to 1
constexpr float kWrongHeat = 0.02f;  // share of cases in which the joint is not where the network's heat is
constexpr float kSurest = 0.98f;     // no hint is certain
constexpr float kGrow = 0.25f;       // of the box's size

/// A hint in the crop.
struct Evidence {
    Evidence(const JointHint& hint, const CropView& view) : confidence(std::min(hint.confidence, kSurest)) {
        const Vec2 from_centre = Vec2(hint.x, hint.y) - view.centre;
        const float half = 0.5f * CropView::kPixels;
        place = {glm::dot(from_centre, view.right) / glm::dot(view.right, view.right) / half,
                 glm::dot(from_centre, view.down) / glm::dot(view.down, view.down) / half};
    }
    bool counts() const {
        return confidence > 0.0f && std::abs(place.x) <= 1.0f && std::abs(place.y) <= 1.0f;
    }
    /// Density of the hint for a joint in that cell.
    float of(int x, int y) const {
        const float dx = (JointMaps::place_of(x) - place.x) / kSigma,
                    dy = (JointMaps::place_of(y) - place.y) / kSigma;
        const float anywhere = 0.25f * (1.0f - confidence);  // over the crop, whose area is 4
        return anywhere + confidence / (2.0f * kPi * kSigma * kSigma) * std::exp(-0.5f * (dx * dx + dy * dy));
    }

    float confidence;
    Vec2 place{0.0f};
};

/// visit(logit, belief that the joint is there) for each cell.
template <typename Logit, typename Visit>
void for_each_cell(Logit* logits, const Visit& visit) {
    const float highest = *std::max_element(logits, logits + JointMaps::kCells);
    float sum = 0.0f;
    for (int i = 0; i < JointMaps::kCells; ++i) sum += std::exp(logits[i] - highest);
    for (int y = 0; y < JointMaps::kSide; ++y)
        for (int x = 0; x < JointMaps::kSide; ++x) {
            Logit& logit = logits[y * JointMaps::kSide + x];
            visit(x, y, logit,
                  (1.0f - kWrongHeat) * std::exp(logit - highest) / sum + kWrongHeat / JointMaps::kCells);
        }
}

float log_chance(const Evidence& evidence, const JointMaps& maps, int joint) {
    float chance = 0.0f;
    for_each_cell(maps.heat.data() + size_t(joint) * JointMaps::kCells,
                  [&](int x, int y, float, float belief) { chance += belief * evidence.of(x, y); });
    return std::log(chance);
}

}  // namespace

void answer_facing(std::span<const JointHint> hints, const CropView& view, JointMaps& maps) {
    for (const JointHint& hint : hints) {
        const int other = mirrored_joint(hint.joint);
        const Evidence evidence(hint, view);
        if (other != hint.joint && evidence.counts())
            maps.away += log_chance(evidence, maps, other) - log_chance(evidence, maps, hint.joint);
    }
}

void apply_hints(std::span<const JointHint> hints, const CropView& view, bool away, JointMaps& maps) {
    for (const JointHint& hint : hints) {
        const Evidence evidence(hint, view);
        if (!evidence.counts()) continue;
        const int joint = away ? mirrored_joint(hint.joint) : hint.joint;
        for_each_cell(
            maps.heat.data() + size_t(joint) * JointMaps::kCells,
            [&](int x, int y, float& logit, float belief) { logit = std::log(belief * evidence.of(x, y)); });
    }
}

bool near_box(const JointHint& hint, const PixelBox& box) {
    if (box.empty()) return true;  // anywhere
    const float more = kGrow * float(std::max(box.x1 - box.x0, box.y1 - box.y0));
    return hint.x >= float(box.x0) - more && hint.x <= float(box.x1) + more &&
           hint.y >= float(box.y0) - more && hint.y <= float(box.y1) + more;
}

}  // namespace vfit
