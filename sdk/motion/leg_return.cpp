#include "motion/leg_return.h"

#include <algorithm>
#include <cmath>

#include "math/quaternion.h"
#include "motion/glide.h"

namespace vfit {

namespace {

constexpr float kReleaseS = 0.05f;  // in a few of these the posture is the tracked one
// Angular acceleration of a leg that comes free and of a foot that stands, rad/s^2: trackers lose a hidden
// foot and find it again elsewhere. It grows by e in each kFreedomS of a swing: who kicks is shown as fast as
// that.
constexpr float kCalm = 45.0f, kFreedomS = 0.1f;

}  // namespace

float LegReturn::most() const { return kCalm * (stands_ ? 1.0f : std::exp(since_s_ / kFreedomS)); }

void LegReturn::turn(Leg& leg, float dt_s) {
    since_s_ = std::min(since_s_ + dt_s, kLong);
    if (since_s_ >= kLong) return;
    const float left = left_of_glide(since_s_, kReleaseS);
    leg.turn_to(fraction(by_upper_, left) * leg.upper, fraction(by_lower_, left) * leg.lower);
}

void LegReturn::release(const Leg& tracked, const Leg& stood) {
    by_upper_ = stood.upper * glm::conjugate(tracked.upper);
    by_lower_ = stood.lower * glm::conjugate(tracked.lower);
    since_s_ = 0.0f;
}

void LegReturn::stand(const Leg& stood, float dt_s) {
    stands_ = true;
    upper_.set(stood.upper, dt_s);
    lower_.set(stood.lower, dt_s);
}

void LegReturn::swing(Leg& leg, float dt_s) {
    stands_ = false;
    leg.turn_to(upper_.follow(leg.upper, most(), dt_s), lower_.follow(leg.lower, most(), dt_s));
}

void LegReturn::turn_foot(Leg& leg, float dt_s) {
    const Quat to_shank = glm::conjugate(leg.lower);
    if (stands_) {
        leg.foot = standing_foot_.follow(leg.foot, most(), dt_s);
        free_foot_.set(to_shank * leg.foot, dt_s);
    } else {
        leg.foot = leg.lower * free_foot_.follow(to_shank * leg.foot, most(), dt_s);
        standing_foot_.set(leg.foot, dt_s);
    }
}

}  // namespace vfit
