// What one foot says about the root's height: as high as the knee, which everybody sees, was tracked. Near
// full stretch a centimetre of height, which nobody sees, is 17 degrees of the knee.
#pragma once

#include "math/types.h"

namespace vfit {

class HeightVote {
public:
    /// Of a foot that stands: how far up its hip must go so that the leg, `length_m` long, reaches `target`.
    void stand(const Vec3& hip, const Vec3& target, float length_m, float dt_s);
    /// Of one that is free, quietly: how far up it must go so that it is where its joint was seen.
    void swing(float rise_m, float dt_s) { say(false, rise_m, dt_s); }
    /// Of one that is free and not seen: what it said last.
    void swing_unseen(float dt_s) { say(false, target_m_, dt_s); }

    float rise_m() const { return rise_m_; }
    float weight() const { return weight_; }

private:
    void say(bool stands, float rise_m, float dt_s);

    bool known_ = false, stands_ = false;
    float target_m_ = 0.0f, rise_m_ = 0.0f, weight_ = 0.0f;
    float jump_m_ = 0.0f, since_s_ = 0.0f;  // at touchdown and release, from what it says then to what it said before
};

}  // namespace vfit
