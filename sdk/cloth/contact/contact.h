// Contact of a moving vertex with one moving sphere or tapered capsule during a sub-step, with friction.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "body/collider.h"
#include "math/types.h"

namespace vfit {

/// A box, for culling.
struct Bounds {
    Vec3 low{INFINITY}, high{-INFINITY};

    void add(const Vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Bounds& o) { low = glm::min(low, o.low), high = glm::max(high, o.high); }
    bool overlaps(const Bounds& o) const {
        return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
               low.z <= o.high.z && o.low.z <= high.z;
    }
};

/// A tapered capsule at one moment; a sphere has a == b.
struct Capsule {
    Vec3 a, b;
    float radius_a, radius_b;

    bool is_ball() const { return a == b; }
    bool operator==(const Capsule&) const = default;
};

/// A capsule with what the distance to it needs again and again.
struct CapsuleShape {
    Vec3 a, axis;           // from a to b
    float radius, taper;    // at a, and what it grows by towards b
    float inverse_length2;  // 0: a ball
    float lean;             // taper over the length of the cone's side

    CapsuleShape() = default;
    explicit CapsuleShape(const Capsule& capsule);
    Vec3 center(float along) const { return a + axis * along; }
    float radius_at(float along) const { return radius + taper * along; }
};

/// A collider's way through one sub-step.
struct SweptCapsule {
    CapsuleShape from, to;
    float travel_m = 0.0f;  // no point of its surface moves further (radii and length kept)
    Bounds bounds;
};

/// Collider as a capsule with `thickness_m` more radius. Of a capsule whose one ball lies inside the other
/// only the bigger ball is left.
Capsule capsule_of(const Collider& collider, float thickness_m);
SweptCapsule sweep(const Capsule& previous, const Capsule& current, float from, float to);

/// Which ball of the capsule is nearest to p (0 at a, 1 at b): the surface there is the ball's.
inline float nearest_along(const CapsuleShape& c, const Vec3& p) {
    if (c.inverse_length2 == 0.0f) return 0.0f;
    const Vec3 from_a = p - c.a;
    const float dot = glm::dot(from_a, c.axis) * c.inverse_length2;
    // The ball that touches p's side of the cone stands lean * (distance from the axis) further along.
    const Vec3 square = from_a - c.axis * dot;
    return std::clamp(dot + c.lean * std::sqrt(glm::dot(square, square) * c.inverse_length2), 0.0f, 1.0f);
}

struct NearestBall {
    float along;
    Vec3 normal;     // from the ball's centre towards p
    float distance;  // of p from the surface, negative inside
};
NearestBall nearest_ball(const CapsuleShape& capsule, const Vec3& p);

/// May a vertex that ends at p, and whose way was no longer than travel_m, have met the collider?
inline bool may_touch(const SweptCapsule& collider, const Vec3& p, float travel_m) {
    const float along = nearest_along(collider.to, p);
    const Vec3 d = p - collider.to.center(along);
    const float reach = collider.to.radius_at(along) + travel_m + collider.travel_m;
    return glm::dot(d, d) < reach * reach;
}

struct ContactSettings {
    float friction_static = 0.0f, friction_kinetic = 0.0f;
    float max_depenetration_m = 0.0f;  // a vertex that began inside comes out by no more than this
};

/// Moves p, the end of a vertex's way from `start`, out of the collider; true where it touched.
bool resolve_contact(const SweptCapsule& collider, const Vec3& start, const ContactSettings& settings,
                     Vec3& p);

/// Coulomb friction on p, pushed out by `depth_m` along `normal`: takes away the sliding relative to the
/// surface's own motion, all of it within the cone, else the kinetic share.
void apply_friction(const Vec3& start, const Vec3& surface_motion, const Vec3& normal, float depth_m,
                    const ContactSettings& settings, Vec3& p);

}  // namespace vfit
