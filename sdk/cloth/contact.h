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
    void grow(float by) {
        low -= by;
        high += by;
    }
    bool overlaps(const Bounds& o) const {
        return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
               low.z <= o.high.z && o.low.z <= high.z;
    }
};

/// A tapered capsule at one moment; a sphere has a == b.
struct Capsule {
    Vec3 a, b;
    float radius_a, radius_b;
};

/// A collider's way through one sub-step.
struct SweptCapsule {
    Capsule from, to;
    float travel_m = 0.0f;  // no point of its surface moves further (radii and length kept)
    Bounds bounds;
};

/// Collider as a capsule with `thickness_m` more radius. Of a capsule whose one ball lies inside the other
/// only the bigger ball is left.
Capsule capsule_of(const Collider& collider, float thickness_m);
SweptCapsule sweep(const Capsule& previous, const Capsule& current, float from, float to);

/// The ball of the capsule that is nearest to p: the surface there is the ball's.
struct NearestBall {
    float along;     // 0 at a, 1 at b
    Vec3 normal;     // from the ball's centre towards p
    float distance;  // of p from the surface, negative inside
};
NearestBall nearest_ball(const Capsule& capsule, const Vec3& p);

struct ContactSettings {
    float friction_static = 0.0f, friction_kinetic = 0.0f;
    float max_depenetration_m = 0.0f;  // a vertex that began inside comes out by no more than this
};

/// Moves p, the end of a vertex's way from `start`, out of the collider; true where it touched.
bool resolve_contact(const SweptCapsule& collider, const Vec3& start, const ContactSettings& settings, Vec3& p);

/// Coulomb friction on p, pushed out by `depth_m` along `normal`: takes away the sliding relative to the
/// surface's own motion, all of it within the cone, else the kinetic share.
void apply_friction(const Vec3& start, const Vec3& surface_motion, const Vec3& normal, float depth_m,
                    const ContactSettings& settings, Vec3& p);

}  // namespace vfit
