#include "motion/foot_pin.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Time constants of the glide: a foot that touches down stands within two frames; one that is free returns to
// where it is tracked in a few steps of a frame.
constexpr float kStopS = 0.0065f, kReleaseS = 0.05f;
// With which a standing foot takes its height: of the floor while that is sought, and of a heel that rises.
constexpr float kHeightS = 0.05f;
// Above the floor, the ankle of a whole foot on it is seen so high at most, and that of a foot on its ball
// from the second on.
constexpr float kWholeFootM = 0.05f, kBallOfFootM = 0.1f;
constexpr float kFloorSlackM =
    0.003f;  // a foot stays where it stands while the floor is found to be so close
// No step is shorter in time and as short in space: a foot that is so soon tracked where it stood never left.
constexpr float kNoStepS = 0.3f, kNoStepM = 0.03f;
constexpr float kMeanS = 1.0f;       // of the tracked place of a foot that stands
constexpr float kVelocityS = 0.03f;  // low-pass of the tracked velocity
constexpr float kFastest = 1.0f;     // m/s: a foot that comes to stand was no faster

Vec3 at_most(const Vec3& velocity, float fastest) {
    const float speed = glm::length(velocity);
    return speed > fastest ? velocity * (fastest / speed) : velocity;
}

}  // namespace

float standing_height(float ankle_m, float level_m) {
    const float above = ankle_m - level_m;
    return level_m + above * glm::smoothstep(kWholeFootM, kBallOfFootM, above);
}

Vec3 FootPin::update(const Vec3& tracked, bool planted, float stand_y, float dt_s) {
    drag_ = Vec3(0.0f);
    if (!known_) tracked_ = tracked;
    if (dt_s > 0.0f) {
        const Vec3 velocity = (tracked - tracked_) / dt_s;
        tracked_velocity_ += (velocity - tracked_velocity_) * (1.0f - std::exp(-dt_s / kVelocityS));
    }
    tracked_ = tracked;
    const Vec3 shown_velocity = glide_.velocity() + (planted_ ? Vec3(0.0f) : tracked_velocity_);
    if (planted_) {
        const float off = stand_y - place_.y;
        const float beyond = off - std::clamp(off, -kFloorSlackM, kFloorSlackM);
        place_.y += beyond * (1.0f - std::exp(-dt_s / kHeightS));
    }
    if (planted && !planted_) {
        const Vec3 shown = tracked + glide_.value();
        const bool never_left =
            stood_s_ > 0.0f && free_s_ < kNoStepS && glm::length(tracked - tracked_there_) < kNoStepM;
        if (!never_left) {
            place_ = {shown.x, stand_y, shown.z};
            stood_s_ = 0.0f;
        }
        glide_ = known_ ? Glide(shown - place_, at_most(shown_velocity, kFastest)) : Glide();
    } else if (!planted && planted_) {
        // It moves off as it is tracked to move.
        glide_ = Glide(glide_.value() + place_ - tracked);
    }
    planted_ = planted;
    known_ = true;
    if (!planted) {
        free_s_ += dt_s;
        glide_.fade(kReleaseS, dt_s);
        offset_ = glide_.value();
        return tracked + offset_;
    }
    free_s_ = 0.0f;
    stood_s_ += dt_s;
    tracked_there_ =
        stood_s_ > dt_s ? glm::mix(tracked_there_, tracked, std::min(1.0f, dt_s / std::min(stood_s_, kMeanS)))
                        : tracked;
    glide_.fade(kStopS, dt_s);
    offset_ = place_ + glide_.value() - tracked;
    const float length = glm::length(offset_);
    if (length > leash_m_) {
        drag_ = offset_ * (leash_m_ / length - 1.0f);
        offset_ += drag_;
        place_ += drag_;
    }
    return tracked + offset_;
}

}  // namespace vfit
