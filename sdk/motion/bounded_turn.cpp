#include "motion/bounded_turn.h"

#include <algorithm>
#include <cmath>

#include "math/quaternion.h"

namespace vfit {

namespace {

constexpr float kLeastRad = 1e-6f;
constexpr float kCatchUpS = 0.2f;  // time constant

}  // namespace

Quat BoundedTurn::follow(const Quat& tracked, float most, float dt_s) {
    if (!known_) set(tracked, 0.0f);
    if (dt_s <= 0.0f) return shown_;
    // As fast as what is tracked, and faster by what is left to catch up.
    const Vec3 wanted = rotation_vector(tracked * glm::conjugate(tracked_)) / dt_s +
                        rotation_vector(tracked_ * glm::conjugate(shown_)) / std::max(kCatchUpS, dt_s);
    const Vec3 change = wanted - velocity_;
    velocity_ += change * std::min(1.0f, most * dt_s / std::max(glm::length(change), kLeastRad));
    tracked_ = tracked;
    return shown_ = glm::normalize(rotation_by(velocity_ * dt_s) * shown_);
}

void BoundedTurn::set(const Quat& shown, float dt_s) {
    if (known_ && dt_s > 0.0f) velocity_ = rotation_vector(shown * glm::conjugate(shown_)) / dt_s;
    shown_ = tracked_ = shown;
    known_ = true;
}

}  // namespace vfit
