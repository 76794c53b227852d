// How a leg whose foot came free returns to its tracked posture. The posture fades, not the ankle's place: a
// straight leg's knee bends with the square root of how far its ankle comes nearer, and would snap.
#pragma once

#include "motion/bounded_turn.h"
#include "motion/leg.h"

namespace vfit {

class LegReturn {
public:
    /// First in each step: turns a tracked leg by what is left of its release, `dt_s` after the last step.
    void turn(Leg& leg, float dt_s);

    /// Its foot has just come free: from `stood`, the leg as if it were still planted.
    void release(const Leg& tracked, const Leg& stood);
    /// Last in each step, one of the two.
    void stand(const Leg& stood, float dt_s);
    void swing(Leg& leg, float dt_s);

    /// The foot, after that: one that stands turns in the world, one that is free on its shank.
    void turn_foot(Leg& leg, float dt_s);

private:
    float most() const;

    Quat by_upper_{1, 0, 0, 0}, by_lower_{1, 0, 0, 0};  // from the tracked leg to the stood one
    float since_s_ = kLong;                             // the release
    bool stands_ = false;
    BoundedTurn upper_, lower_, standing_foot_, free_foot_;

    static constexpr float kLong = 1.0f;  // s: nothing is left of a release
};

}  // namespace vfit
