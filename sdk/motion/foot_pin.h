// Where one foot is shown: at the place where it was planted (paper, Algorithm 5, recordFootPosition), and
// where it is tracked while it is free. From one to the other it glides without a jump of place or of force.
#pragma once

#include "math/types.h"
#include "motion/glide.h"

namespace vfit {

/// At which a planted foot stands whose ankle is seen at `ankle_m`: `level_m`, that of the floor, for a whole
/// foot, and where it is seen for one on its ball.
float standing_height(float ankle_m, float level_m);

class FootPin {
public:
    /// A planted foot that is tracked further than `leash_m` from its place is dragged along.
    explicit FootPin(float leash_m) : leash_m_(leash_m) {}

    /// The place to show for a foot tracked at `tracked`. While planted it stands where it came down, or
    /// where it stood before if it never left, at the height `stand_y`.
    Vec3 update(const Vec3& tracked, bool planted, float stand_y, float dt_s);

    /// A foot that is free was shown at `place` after all.
    void showed(const Vec3& place) { glide_ = Glide(place - tracked_); }

    /// Moves the recorded place.
    void move(const Vec3& by) { place_ += by; }

    bool planted() const { return planted_; }
    /// Where it stands, or stood when it came free.
    const Vec3& place() const { return place_; }
    /// From the tracked place to the shown one.
    const Vec3& offset() const { return offset_; }
    /// How far the last update dragged the recorded place.
    const Vec3& drag() const { return drag_; }

private:
    float leash_m_;
    bool planted_ = false, known_ = false;
    Vec3 place_{0.0f};                      // recorded
    Vec3 tracked_there_{0.0f};              // where the foot was tracked while it stood there, mean
    float stood_s_ = 0.0f, free_s_ = 0.0f;  // for so long
    Vec3 tracked_{0.0f}, tracked_velocity_{0.0f};
    Glide glide_;  // from where it goes to, place or tracked, to where it is shown
    Vec3 offset_{0.0f}, drag_{0.0f};
};

}  // namespace vfit
