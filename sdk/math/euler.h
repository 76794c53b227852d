// Rotations as three angles, for the formats of others that have no quaternions. Radians.
#pragma once

#include "math/types.h"

namespace vfit {

struct EulerAngles {
    double x = 0, y = 0, z = 0;
};

/// R = Ry Rx Rz, the order of Unity: about Z, then X, then Y of the world; x in [-90, 90] degrees.
EulerAngles euler_yxz(const Quat& q);

/// R = Rz Rx Ry, the order of BVH channels "Zrotation Xrotation Yrotation". Of all angles that mean this
/// rotation those next to `before`, so that no angle jumps from one frame of a motion to the next.
EulerAngles euler_zxy(const Quat& q, const EulerAngles& before);

}  // namespace vfit
