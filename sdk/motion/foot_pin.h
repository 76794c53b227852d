// Where one foot is shown: at the place recorded when it was planted (paper, Algorithm 5,
// recordFootPosition), and gliding back to where it is tracked once it is free.
#pragma once

#include "math/types.h"

namespace vfit {

class FootPin {
public:
    void reset() { *this = FootPin(); }

    /// The place to show for a foot tracked at `tracked`. While planted it settles to `floor_y` in height.
    Vec3 update(const Vec3& tracked, bool planted, float floor_y, float dt_s);

    bool planted() const { return planted_; }
    /// From the tracked place to the shown one.
    const Vec3& offset() const { return offset_; }

    static constexpr float kGlideTimeS = 0.1f;  // time constant of release and of settling
    // A planted foot that is tracked further away is dragged along: the person slides it.
    static constexpr float kLeashM = 0.15f;

private:
    bool planted_ = false;
    Vec3 recorded_{0.0f}, offset_{0.0f};
};

}  // namespace vfit
