// Foot-skate correction on the tracked joints themselves, for hosts that use joints and no skeleton: the
// ankle is pinned, the toes go with it, the knee follows.
#pragma once

#include <array>

#include "frame/body.h"
#include "motion/foot_pin.h"

namespace vfit {

class JointFeet {
public:
    void reset() { *this = JointFeet(); }

    /// `knee_fronts`: where the knees point to, left and right.
    void apply(const bool planted[2], const Vec3 knee_fronts[2], float ankle_level, float dt_s, Body& body);

private:
    std::array<FootPin, 2> pins_;
};

}  // namespace vfit
