#include "cloth/contact/contact.h"

#include <optional>

namespace vfit {

namespace {

constexpr float kLeastLength_m = 1e-6f;  // shorter ones have no direction

Vec3 lerp(const Vec3& a, const Vec3& b, float t) { return a + (b - a) * t; }

/// First time in (0, 1) at which a relative path q0 -> q1 that begins outside enters a radius that goes from
/// r0 to r1: (m00 - 2 m01 + m11) t^2 + 2 (m01 - m00) t + m00 = 0, the smaller root.
std::optional<float> entry_time(const Vec3& q0, const Vec3& q1, float r0, float r1) {
    const float m00 = glm::dot(q0, q0) - r0 * r0;
    const float m11 = glm::dot(q1, q1) - r1 * r1;
    const float m01 = glm::dot(q0, q1) - r0 * r1;
    const float discriminant = m01 * m01 - m00 * m11;
    if (m00 < 0.0f || discriminant < 0.0f) return {};
    // (m00 - m01 - root) / a, written so that it also holds where a is zero or negative.
    const float denominator = m00 - m01 + std::sqrt(discriminant);
    if (!(denominator > m00)) return {};
    return m00 / denominator;
}

struct Hit {
    float along;
    Vec3 normal;
};

std::optional<Hit> hit_ball(const SweptCapsule& c, const Vec3& start, const Vec3& end, float along) {
    const Vec3 q0 = start - c.from.center(along);
    const Vec3 q1 = end - c.to.center(along);
    const float radius = c.to.radius_at(along);
    const std::optional<float> t = entry_time(q0, q1, radius, radius);
    if (!t) return {};
    const Vec3 normal = lerp(q0, q1, *t);
    const float length = glm::length(normal);
    if (length < kLeastLength_m) return {};  // a ball without a radius, met in its middle
    return Hit{along, normal / length};
}

/// Part of p square to the unit axis, and the radius of the (endless) cone where p stands beside it.
struct BesideAxis {
    Vec3 square;
    float radius;
};
BesideAxis beside_axis(const CapsuleShape& c, const Vec3& p) {
    const Vec3 from_a = p - c.a;
    const float along = glm::dot(from_a, c.axis) * c.inverse_length2;
    // length / side = sqrt(1 + lean^2), as side^2 = length^2 - taper^2
    const float radius = (c.radius + 0.5f * c.taper) * std::sqrt(1.0f + c.lean * c.lean) +
                         (along - 0.5f) * c.lean / std::sqrt(c.inverse_length2);
    return {from_a - c.axis * along, std::max(radius, 0.0f)};
}

/// Where the way from start to end first meets the swept collider. The cone's polynomial of degree six is
/// replaced by a quadratic: length and slope of the capsule stay constant over the sub-step.
std::optional<Hit> first_hit(const SweptCapsule& c, const Vec3& start, const Vec3& end) {
    if (c.to.inverse_length2 == 0.0f) return hit_ball(c, start, end, 0.0f);
    const BesideAxis from = beside_axis(c.from, start), to = beside_axis(c.to, end);
    if (const std::optional<float> t = entry_time(from.square, to.square, from.radius, to.radius)) {
        CapsuleShape at = c.to;
        at.a = lerp(c.from.a, c.to.a, *t);
        at.axis = lerp(c.from.axis, c.to.axis, *t);
        const NearestBall ball = nearest_ball(at, lerp(start, end, *t));
        if (ball.along > 0.0f && ball.along < 1.0f) return Hit{ball.along, ball.normal};
    }
    std::optional<Hit> hit = hit_ball(c, start, end, 0.0f);
    return hit ? hit : hit_ball(c, start, end, 1.0f);
}

}  // namespace

Capsule capsule_of(const Collider& collider, float thickness_m) {
    Capsule c{collider.center, collider.center, collider.radius + thickness_m, collider.radius + thickness_m};
    if (!collider.is_capsule()) return c;
    c.b = collider.center_b;
    c.radius_b = collider.radius_b + thickness_m;
    if (glm::length(c.b - c.a) <= 1.0001f * std::abs(c.radius_b - c.radius_a) || c.a == c.b) {
        if (c.radius_b > c.radius_a)
            c = {c.b, c.b, c.radius_b, c.radius_b};
        else
            c = {c.a, c.a, c.radius_a, c.radius_a};
    }
    return c;
}

CapsuleShape::CapsuleShape(const Capsule& c)
    : a(c.a),
      axis(c.b - c.a),
      radius(c.radius_a),
      taper(c.radius_b - c.radius_a),
      inverse_length2(0.0f),
      lean(0.0f) {
    const float length2 = glm::dot(axis, axis);
    // On the way of a capsule that turns round, its ends come too close for a cone: the bigger ball is left.
    if (length2 <= 1.0001f * taper * taper || length2 < kLeastLength_m * kLeastLength_m) {
        if (taper > 0.0f) a = c.b;
        radius = std::max(c.radius_a, c.radius_b);
        axis = Vec3(0.0f);
        taper = 0.0f;
        return;
    }
    inverse_length2 = 1.0f / length2;
    lean = taper / std::sqrt(length2 - taper * taper);
}

SweptCapsule sweep(const Capsule& previous, const Capsule& current, float from, float to) {
    const auto at = [&](float t) {
        return Capsule{lerp(previous.a, current.a, t), lerp(previous.b, current.b, t), current.radius_a,
                       current.radius_b};
    };
    const Capsule begin = at(from), end = at(to);
    SweptCapsule s{CapsuleShape(begin), CapsuleShape(end), 0.0f, {}};
    s.travel_m = std::max(glm::length(end.a - begin.a), glm::length(end.b - begin.b));
    for (const Capsule& c : {begin, end}) {
        s.bounds.add(c.a - c.radius_a);
        s.bounds.add(c.a + c.radius_a);
        s.bounds.add(c.b - c.radius_b);
        s.bounds.add(c.b + c.radius_b);
    }
    return s;
}

NearestBall nearest_ball(const CapsuleShape& c, const Vec3& p) {
    const float along = nearest_along(c, p);
    const Vec3 from_center = p - c.center(along);
    const float distance = glm::length(from_center);
    const Vec3 normal = distance > 1e-9f ? from_center / distance : Vec3(0, 1, 0);
    return {along, normal, distance - c.radius_at(along)};
}

void apply_friction(const Vec3& start, const Vec3& surface_motion, const Vec3& normal, float depth_m,
                    const ContactSettings& settings, Vec3& p) {
    const Vec3 relative = p - start - surface_motion;
    const Vec3 sliding = relative - normal * glm::dot(relative, normal);
    const float length = glm::length(sliding);
    if (length <= settings.friction_static * depth_m)
        p -= sliding;
    else
        p -= sliding * (settings.friction_kinetic * depth_m / length);
}

bool resolve_contact(const SweptCapsule& c, const Vec3& start, const ContactSettings& settings, Vec3& p) {
    const NearestBall end = nearest_ball(c.to, p);
    // The surface cannot have been met by a way (relative to it) that is shorter than what is left to it.
    if (end.distance >= glm::length(p - start) + c.travel_m) return false;
    const NearestBall begin = nearest_ball(c.from, start);
    Hit hit{end.along, end.normal};
    const bool same_side = glm::dot(begin.normal, end.normal) > 0.0f;
    if (end.distance >= 0.0f || !same_side) {
        if (begin.distance <= 0.0f) {
            if (same_side) return false;  // on its way out
            hit = {begin.along, begin.normal};
        } else if (const std::optional<Hit> first = first_hit(c, start, p)) {
            hit = *first;
        } else if (end.distance >= 0.0f) {
            return false;
        }
    }
    const Vec3 center_from = c.from.center(hit.along), center_to = c.to.center(hit.along);
    const float radius = c.to.radius_at(hit.along);
    const float residue = std::max(0.0f, -begin.distance - settings.max_depenetration_m);
    const float depth = radius - glm::dot(p - center_to, hit.normal) - residue;
    if (depth <= 0.0f) return false;
    p += hit.normal * depth;

    // The surface moves with its ball and turns with the axis: w x n r = dA (A.n) - A (dA.n), times r.
    Vec3 surface_motion = center_to - center_from;
    if (const float inverse_length2 = c.to.inverse_length2; inverse_length2 > 0.0f) {
        const Vec3 turned = c.to.axis - c.from.axis;
        surface_motion +=
            radius * inverse_length2 *
            (turned * glm::dot(c.to.axis, hit.normal) - c.to.axis * glm::dot(turned, hit.normal));
    }
    apply_friction(start, surface_motion, hit.normal, depth, settings, p);
    return true;
}

}  // namespace vfit
