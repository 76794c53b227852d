#include "cloth/contact/collider_motion.h"

namespace vfit {

void ColliderMotion::accept(std::span<const Collider> colliders, float thickness_m) {
    interval_ = {};
    current_.resize(colliders.size());
    for (size_t i = 0; i < colliders.size(); ++i) current_[i] = capsule_of(colliders[i], thickness_m);
    same_ = previous_.size() == current_.size();
    if (!same_) previous_ = current_;
    needed_.clear();
    needed_.reserve(current_.size());
    for (uint32_t i = 0; i < current_.size(); ++i) {
        // A capsule that became a ball, or the reverse, has no way between the two.
        if (previous_[i].is_ball() != current_[i].is_ball()) {
            previous_[i] = current_[i];
            same_ = false;
        }
        if (!is_end_of_another(i)) needed_.push_back(i);
    }
}

/// A ball that a capsule has at one of its ends, now and before, adds nothing to that capsule.
bool ColliderMotion::is_end_of_another(uint32_t ball) const {
    if (!current_[ball].is_ball()) return false;
    const auto end_of = [&](const Capsule& c, const Capsule& other) {
        return (c.a == other.a && c.radius_a <= other.radius_a) ||
               (c.a == other.b && c.radius_a <= other.radius_b);
    };
    for (size_t i = 0; i < current_.size(); ++i)
        if (!current_[i].is_ball() && end_of(current_[ball], current_[i]) &&
            end_of(previous_[ball], previous_[i]))
            return true;
    return false;
}

void ColliderMotion::skip(float fraction) {
    for (size_t i = 0; i < current_.size(); ++i) {
        Capsule& from = previous_[i];
        const Capsule& to = current_[i];
        const bool ball = from.is_ball();
        from.a = glm::mix(from.a, to.a, fraction);
        from.b = ball ? from.a : glm::mix(from.b, to.b, fraction);
        from.radius_a = glm::mix(from.radius_a, to.radius_a, fraction);
        from.radius_b = glm::mix(from.radius_b, to.radius_b, fraction);
    }
}

float ColliderMotion::greatest_way() const {
    float most = same_ ? 0.0f : INFINITY;
    for (size_t i = 0; i < current_.size(); ++i) {
        const Capsule &from = previous_[i], &to = current_[i];
        most = std::max({most, glm::length(to.a - from.a) + std::abs(to.radius_a - from.radius_a),
                         glm::length(to.b - from.b) + std::abs(to.radius_b - from.radius_b)});
    }
    return most;
}

Bounds ColliderMotion::ways() const {
    Bounds ways;
    for (size_t i = 0; i < current_.size(); ++i) {
        ways.add(current_[i].a - previous_[i].a);
        ways.add(current_[i].b - previous_[i].b);
    }
    return ways;
}

void ColliderMotion::sweep(float from, float to, std::vector<SweptCapsule>& out) const {
    out.reserve(current_.size());
    out.resize(needed_.size());
    for (size_t i = 0; i < needed_.size(); ++i)
        out[i] =
            vfit::sweep(previous_[needed_[i]], current_[needed_[i]], interval_.at(from), interval_.at(to));
}

}  // namespace vfit
