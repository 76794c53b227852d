#include "math/quaternion.h"

#include <algorithm>
#include <cmath>

namespace vfit {

Quat shortest_arc(const Vec3& from, const Vec3& to) {
    const Vec3 a = glm::normalize(from), b = glm::normalize(to);
    const float cosine = glm::dot(a, b);
    if (cosine > -0.999999f) {
        const Vec3 axis = glm::cross(a, b);
        return glm::normalize(Quat(1.0f + cosine, axis.x, axis.y, axis.z));
    }
    // Opposite directions: half a turn about any axis square to `a`.
    const Vec3 other = std::abs(a.x) < 0.7f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    const Vec3 axis = glm::normalize(glm::cross(a, other));
    return Quat(0.0f, axis.x, axis.y, axis.z);
}

SwingTwist split_swing_twist(const Quat& q, const Vec3& axis) {
    const float along = q.x * axis.x + q.y * axis.y + q.z * axis.z;
    const float length = std::sqrt(q.w * q.w + along * along);
    // A half turn of pure swing leaves the twist undefined: none is the choice that does not jump.
    if (length < 1e-6f) return {q, Quat(1, 0, 0, 0)};
    const Quat twist(q.w / length, axis.x * along / length, axis.y * along / length, axis.z * along / length);
    return {q * glm::conjugate(twist), twist};
}

Quat same_hemisphere(const Quat& q, const Quat& reference) { return glm::dot(q, reference) < 0.0f ? -q : q; }

namespace {

// Below this sine of half the angle, series are exact to float's last bit, and quicker than the library's.
constexpr float kSmallSine = 0.25f;

/// asin(sine) / sine
float arc_over_sine(float sine) {
    const float s2 = sine * sine;
    return 1.0f + s2 * (1.0f / 6.0f + s2 * (3.0f / 40.0f + s2 * (15.0f / 336.0f + s2 * (105.0f / 3456.0f))));
}

/// sin(x) / x
float sine_over_arc(float x) {
    const float x2 = x * x;
    return 1.0f + x2 * (-1.0f / 6.0f + x2 * (1.0f / 120.0f - x2 * (1.0f / 5040.0f)));
}

}  // namespace

Quat fraction(const Quat& q, float t) {
    const Quat shortest = q.w < 0.0f ? -q : q;
    const Vec3 v(shortest.x, shortest.y, shortest.z);
    const float sine = glm::length(v);
    if (sine < kSmallSine && std::abs(t) <= 1.0f) {
        const float half = sine * arc_over_sine(sine) * t;
        const Vec3 axis = v * (arc_over_sine(sine) * t * sine_over_arc(half));
        return Quat(std::sqrt(1.0f - glm::dot(axis, axis)), axis.x, axis.y, axis.z);
    }
    const float half = std::atan2(sine, shortest.w) * t;
    const Vec3 axis = v * (std::sin(half) / sine);
    return Quat(std::cos(half), axis.x, axis.y, axis.z);
}

Vec3 rotation_vector(const Quat& q) {
    const Vec3 v = q.w < 0.0f ? -Vec3(q.x, q.y, q.z) : Vec3(q.x, q.y, q.z);
    const float sine = glm::length(v);
    return v * (2.0f * (sine < kSmallSine ? arc_over_sine(sine) : std::atan2(sine, std::abs(q.w)) / sine));
}

Quat rotation_by(const Vec3& vector) {
    const float half = 0.5f * glm::length(vector);
    const Vec3 axis = vector * (0.5f * (half < kSmallSine ? sine_over_arc(half) : std::sin(half) / half));
    return Quat(half < kSmallSine ? std::sqrt(1.0f - glm::dot(axis, axis)) : std::cos(half), axis.x, axis.y,
                axis.z);
}

float angle_of(const Quat& q) {
    return 2.0f * std::atan2(std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z), std::abs(q.w));
}

}  // namespace vfit
