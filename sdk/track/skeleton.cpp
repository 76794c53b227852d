#include "track/skeleton.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kKeep = 0.9f;          // of the doubt, a frame
constexpr float kAnswerLimit = 3.0f;   // one frame's logit counts no more
constexpr float kTurnAbout = 18.0f;    // doubt at which the decision falls: nine frames of firm answers

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
        const float highest = *std::max_element(logits, logits + JointMaps::kCells);
        float sum = 0.0f;
        Vec3 place(0.0f);
        for (int y = 0; y < JointMaps::kSide; ++y) {
            float row = 0.0f;
            for (int x = 0; x < JointMaps::kSide; ++x) {
                const size_t i = size_t(y * JointMaps::kSide + x);
                const float below = logits[i] - highest;
                const float h = heat[i] = below > -20.0f ? std::exp(below) : 0.0f;
                row += h;
                place.x += h * JointMaps::place_of(x);
                place.z += h * depth[i];
            }
            place.y += row * JointMaps::place_of(y);
            sum += row;
        }
        place /= sum;
        float close = 0.0f;
        for (int y = 0; y < JointMaps::kSide; ++y)
            for (int x = 0; x < JointMaps::kSide; ++x) {
                const float dx = JointMaps::place_of(x) - place.x, dy = JointMaps::place_of(y) - place.y;
                if (dx * dx + dy * dy <= near * near) close += heat[size_t(y * JointMaps::kSide + x)];
            }
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
