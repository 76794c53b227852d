#include "track/skeleton.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr int kSide = JointMaps::kSide;
// Crop units about the strongest cell: on virtual people hands came out best at 0.2, the other joints at 0.3 and more.
constexpr float kWindow = 0.3f;
constexpr float kKeep = 0.9f;          // of the doubt, a frame
constexpr float kAnswerLimit = 3.0f;   // one frame's logit counts no more
constexpr float kTurnAbout = 18.0f;    // doubt at which the decision falls: nine frames of firm answers

float place_of(int cell) { return (float(cell) + 0.5f) / (0.5f * kSide) - 1.0f; }

/// Calls each(x, y, cell) for the cells whose middle lies within `radius` of a place.
template <class Each>
void for_cells_within(float radius, float at_x, float at_y, Each&& each) {
    for (int y = 0; y < kSide; ++y) {
        const float dy = place_of(y) - at_y;
        if (std::abs(dy) > radius) continue;
        for (int x = 0; x < kSide; ++x) {
            const float dx = place_of(x) - at_x;
            if (dx * dx + dy * dy <= radius * radius) each(place_of(x), place_of(y), size_t(y * kSide + x));
        }
    }
}

void exchange_sides(SeenJoints& joints) {
    for (int j = 0; j < kJointCount; ++j)
        if (const int other = mirrored_joint(j); other > j) std::swap(joints[size_t(j)], joints[size_t(other)]);
}

/// Sum over paired joints of the distance between the same joint in both.
float distance_between(const SeenJoints& a, const SeenJoints& b) {
    float sum = 0.0f;
    for (int j = 0; j < kJointCount; ++j)
        if (mirrored_joint(j) != j)
            sum += std::min(0.3f, glm::length(a[size_t(j)].position - b[size_t(j)].position));
    return sum;
}

}  // namespace

void read_maps(const JointMaps& maps, const CropView& view, const Camera& camera, SeenJoints& out) {
    constexpr float near = kNear_m / (0.5f * CropView::kSide_m);
    std::array<float, JointMaps::kCells> heat;
    for (size_t j = 0; j < size_t(kJointCount); ++j) {
        const float* logits = maps.heat.data() + j * JointMaps::kCells;
        const float* depth = maps.depth.data() + j * JointMaps::kCells;
        const auto strongest = int(std::max_element(logits, logits + JointMaps::kCells) - logits);
        float sum = 0.0f;
        for (size_t i = 0; i < heat.size(); ++i) {
            const float below = logits[i] - logits[strongest];
            sum += heat[i] = below > -20.0f ? std::exp(below) : 0.0f;
        }
        // The mean about the strongest cell: what lies far off, the other hand say, would draw the joint inwards.
        Vec3 place(0.0f);
        float about = 0.0f;
        const auto add = [&](float x, float y, size_t i) {
            place += heat[i] * Vec3(x, y, depth[i]);
            about += heat[i];
        };
        for_cells_within(kWindow, place_of(strongest % kSide), place_of(strongest / kSide), add);
        place /= about;
        float close = 0.0f;
        for_cells_within(near, place.x, place.y, [&](float, float, size_t i) { close += heat[i]; });
        out[j] = {view.to_camera(camera, place), close / sum};
    }
}

void Facing::apply(float away_logit, SeenJoints& joints) {
    const float answer = std::clamp(away_logit, -kAnswerLimit, kAnswerLimit);
    if (!known_) {
        away_ = answer > 0.0f;
        known_ = true;
        if (away_) exchange_sides(joints);
        last_ = joints;
        return;
    }
    if (away_) exchange_sides(joints);
    // Turned past the side view: the same limbs now stand on the other side of the image.
    SeenJoints other = joints;
    exchange_sides(other);
    if (distance_between(other, last_) < 0.6f * distance_between(joints, last_)) {
        away_ = !away_;
        doubt_ = 0.0f;
        joints = other;
    }
    doubt_ = std::max(0.0f, kKeep * doubt_ + (away_ ? -answer : answer));
    if (doubt_ > kTurnAbout) {
        away_ = !away_;
        doubt_ = 0.0f;
        exchange_sides(joints);
    }
    last_ = joints;
}

}  // namespace vfit
