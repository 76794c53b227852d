#include "motion/standing_level.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kFindS = 1.0f;     // of standing, whose mean is the first level
constexpr float kMeanS = 10.0f;    // time constant after that: trackers err by where in the room a foot stands
constexpr float kUnseen = 0.006f;  // m/s, 0.2 mm in a frame of 30 Hz
// A reading that lies farther off is an error of its joint and counts as no more than this.
constexpr float kMostM = 0.03f;
// Who stands so far off for so long has stepped on another floor.
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
    const float off = std::clamp(off_m, -kMostM, kMostM);
    if (stood_s_ < kFindS)
        level_m_ += off * dt_s / (stood_s_ + dt_s);
    else
        level_m_ += std::clamp(off * std::min(1.0f, dt_s / kMeanS), -kUnseen * dt_s, kUnseen * dt_s);
}

}  // namespace vfit
