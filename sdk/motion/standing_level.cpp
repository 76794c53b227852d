#include "motion/standing_level.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kFindS = 1.0f;  // of standing, after which the level is found
// Time constant of the mean, a fraction of the time stood so far: what a tracker reports before it has
// settled is forgotten with the fourth power of time.
constexpr float kMeanShare = 0.25f, kShortestMeanS = 0.1f, kLongestMeanS = 3.0f;
constexpr float kUnseen = 0.006f;  // m/s, 0.2 mm in a frame of 30 Hz
// A reading that lies farther off is an error of its joint and counts as no more than this.
constexpr float kMaxM = 0.03f;
// A person who stands so far off for so long has stepped on another floor.
constexpr float kOtherFloorM = 0.06f, kOtherFloorS = 0.5f;

}  // namespace

void StandingLevel::update(float height_m, float dt_s) {
    const float off_m = height_m - level_m_;
    elsewhere_s_ = known_ && std::abs(off_m) > kOtherFloorM ? elsewhere_s_ + dt_s : 0.0f;
    if (!known_ || elsewhere_s_ > kOtherFloorS) {
        *this = StandingLevel();
        known_ = true;
        level_m_ = height_m;
        return;
    }
    stood_s_ += dt_s;
    const float mean_s = std::clamp(kMeanShare * stood_s_, kShortestMeanS, kLongestMeanS);
    const float gain = std::min(1.0f, dt_s / mean_s);
    if (stood_s_ < kFindS)
        level_m_ += gain * off_m;
    else
        level_m_ += std::clamp(gain * std::clamp(off_m, -kMaxM, kMaxM), -kUnseen * dt_s, kUnseen * dt_s);
}

}  // namespace vfit
