// The height of the root and the roll of the pelvis. No sensor sees them, but it sees the knees: both legs
// are to be as long as tracked. A leg tells its length the more surely the straighter it is: near full
// stretch 17 degrees of the knee are a centimetre, at a right angle 2 are.
#pragma once

#include "motion/glide.h"
#include "motion/leg.h"

namespace vfit {

/// What one foot says.
struct HeightVote {
    float rise_m = 0.0f;  // how far up its hip must go
    float sd_m = 1e3f;    // how surely
};

/// So that the tracked leg, as long as it is, reaches `target`, where its foot stands.
HeightVote standing_vote(const Leg& tracked, const Vec3& target);
/// So that a foot off the floor is where its ankle was seen. It has a say while no foot stands.
inline HeightVote free_vote(float rise_m) { return {rise_m, 10.0f}; }

class RootHeight {
public:
    /// `stands`: which feet. Where that changes, the root comes to what is said then without a jump.
    void update(const HeightVote votes[2], const bool stands[2], float dt_s);

    /// How far the root goes up.
    float lift_m() const { return lift_m_; }
    /// How far the left hip rises against the right one.
    float slope_m() const { return slope_m_; }

private:
    bool known_ = false;
    bool stands_[2] = {false, false};
    float rise_m_[2] = {0.0f, 0.0f};
    float lift_m_ = 0.0f, slope_m_ = 0.0f;
    Glide jump_;  // of both, from what the feet say to what is shown
};

}  // namespace vfit
