// Quaternion helpers that GLM lacks: shortest arc, swing-twist, rotation by a fraction.
#pragma once

#include "math/types.h"

namespace vfit {

/// The smallest rotation that carries direction `from` to direction `to` (need not be unit length).
Quat shortest_arc(const Vec3& from, const Vec3& to);

struct SwingTwist {
    Quat swing, twist;  // q = swing * twist, twist about the axis
};

/// Splits q into a twist about the unit `axis` and the swing that follows it (q = swing * twist).
SwingTwist split_swing_twist(const Quat& q, const Vec3& axis);

/// q or -q, whichever lies in the hemisphere of `reference`: the same rotation, without a sign jump.
Quat same_hemisphere(const Quat& q, const Quat& reference);

/// Rotation by the fraction `t` of q's angle about q's axis (Eq. 9 and 10 of the paper with t = 1/k).
Quat fraction(const Quat& q, float t);

/// The axis of q times its angle in [0, pi], and back.
Vec3 rotation_vector(const Quat& q);
Quat rotation_by(const Vec3& vector);

/// The rotation angle of q in [0, pi].
float angle_of(const Quat& q);

}  // namespace vfit
