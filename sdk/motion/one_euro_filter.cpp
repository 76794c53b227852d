#include "motion/one_euro_filter.h"

#include <cmath>

namespace vfit {

namespace {

float low_pass_share(float cutoff_hz, float dt_s) {
    const float t = 2.0f * kPi * cutoff_hz * dt_s;
    return t / (t + 1.0f);
}

}  // namespace

Vec3 OneEuroFilter::update(const OneEuroSettings& s, const Vec3& reading, float dt_s) {
    if (!known_) {
        known_ = true;
        velocity_ = Vec3(0.0f);
        return position_ = reading;
    }
    const Vec3 velocity = (reading - position_) / dt_s;
    velocity_ += low_pass_share(s.derivative_cutoff_hz, dt_s) * (velocity - velocity_);
    // Of each axis, as the authors filter each coordinate by itself.
    for (int axis = 0; axis < 3; ++axis) {
        const float cutoff_hz = s.min_cutoff_hz + s.beta * std::abs(velocity_[axis]);
        position_[axis] += low_pass_share(cutoff_hz, dt_s) * (reading[axis] - position_[axis]);
    }
    return position_;
}

}  // namespace vfit
