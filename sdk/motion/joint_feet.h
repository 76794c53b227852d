// Foot-skate correction on the tracked joints themselves, for hosts that use joints and no skeleton: the
// ankle is pinned, the toes go with it, the knee follows.
#pragma once

#include <array>

#include "frame/body.h"
#include "motion/foot_pin.h"

namespace vfit {

// A person whose slow foot is tracked so far from where it was planted slides it: more than a sensor's drift.
inline constexpr float kJointLeashM = 0.15f;

class JointFeet {
public:
    void reset() { *this = JointFeet(); }

    /// `knee_fronts`: where the knees point to, left and right.
    void apply(const bool planted[2], const Vec3 knee_fronts[2], float ankle_level, float dt_s, Body& body);

    /// How far the person slid that planted foot in the last call.
    const Vec3& drag(int side) const { return pins_[static_cast<size_t>(side)].drag(); }

private:
    std::array<FootPin, 2> pins_{FootPin(kJointLeashM), FootPin(kJointLeashM)};
};

}  // namespace vfit
