// What one foot says about the root's height: as high as the knee, which everybody sees, was tracked. Near
// full stretch a centimetre of height, which nobody sees, is 17 degrees of the knee.
#pragma once

#include "math/types.h"

namespace vfit {

class HeightVote {
public:
    /// Of a foot that stands: how far up its hip must go so that the leg, `length_m` long, reaches `target`.
    void stand(const Vec3& hip, const Vec3& target, float length_m, float dt_s);
    /// Of one that is free: what it said last, ever more quietly, and `change_m` of what the other foot says.
    void swing(float change_m, float dt_s);

    float rise_m() const { return rise_m_; }
    float weight() const { return weight_; }
    float change_m() const { return change_m_; }  // of rise_m() in the last step

private:
    void gain(float weight, float dt_s);

    bool known_ = false, stands_ = false;
    float rise_m_ = 0.0f, change_m_ = 0.0f, weight_ = 0.0f;
    float jump_m_ = 0.0f, stood_s_ = 0.0f;  // at the touchdown, from what it says then to what it said before
};

}  // namespace vfit
