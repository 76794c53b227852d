// Finiteness of whole vectors, for the checks at the borders.
#pragma once

#include <cmath>

#include "math/types.h"

namespace vfit {

inline bool finite(float x) { return std::isfinite(x); }
inline bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
inline bool finite(const Quat& q) {
    return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}

}  // namespace vfit
