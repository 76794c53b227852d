// Where one foot is shown: at the place recorded when it was planted (paper, Algorithm 5,
// recordFootPosition), and gliding back to where it is tracked once it is free.
#pragma once

#include "math/types.h"

namespace vfit {

class FootPin {
public:
    /// A planted foot that is tracked further than `leash_m` from its place is dragged along.
    explicit FootPin(float leash_m) : leash_m_(leash_m) {}

    /// The place to show for a foot tracked at `tracked`. While planted it settles to `floor_y` in height.
    Vec3 update(const Vec3& tracked, bool planted, float floor_y, float dt_s);

    /// Moves the recorded place.
    void move(const Vec3& by) { recorded_ += by; }

    bool planted() const { return planted_; }
    /// From the tracked place to the shown one.
    const Vec3& offset() const { return offset_; }
    /// How far the last update dragged the recorded place.
    const Vec3& drag() const { return drag_; }

    static constexpr float kGlideTimeS = 0.1f;  // time constant of release and of settling

private:
    float leash_m_;
    bool planted_ = false;
    Vec3 recorded_{0.0f}, offset_{0.0f}, drag_{0.0f};
};

}  // namespace vfit
