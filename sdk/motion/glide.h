// What fades away without a jump of place, of speed or of force: three equal poles.
#pragma once

#include <cmath>

#include "math/types.h"

namespace vfit {

/// What is left, `age_s` later, of something that was at rest.
inline float left_of_glide(float age_s, float time_s) {
    const float x = age_s / time_s;
    return (1.0f + x + 0.5f * x * x) * std::exp(-x);
}

class Glide {
public:
    Glide() = default;
    explicit Glide(const Vec3& value, const Vec3& velocity = Vec3(0.0f))
        : value_(value), velocity_(velocity) {}

    const Vec3& value() const { return value_; }
    const Vec3& velocity() const { return velocity_; }

    /// (p + q t + r t^2 / 2) exp(-t / time_s), exact for any interval.
    void fade(float time_s, float dt_s) {
        const float rate = 1.0f / time_s, left = std::exp(-rate * dt_s);
        const Vec3 q = velocity_ + rate * value_;
        const Vec3 r = acceleration_ + 2.0f * rate * velocity_ + rate * rate * value_;
        const Vec3 p = value_ + q * dt_s + r * (0.5f * dt_s * dt_s), p1 = q + r * dt_s;
        value_ = left * p;
        velocity_ = left * (p1 - rate * p);
        acceleration_ = left * (r - 2.0f * rate * p1 + rate * rate * p);
        if (glm::length(value_) < kNothing && glm::length(velocity_) < kNothing) *this = Glide();
    }

private:
    static constexpr float kNothing = 1e-5f;
    Vec3 value_{0.0f}, velocity_{0.0f}, acceleration_{0.0f};
};

}  // namespace vfit
