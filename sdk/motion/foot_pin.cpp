#include "motion/foot_pin.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Time constants of the springs: a foot that touches down stands within two frames; one that is free returns to where it
// is tracked in a few steps of a frame. A foot that came to stand beside the floor goes there unseen, two millimetres a
// frame.
constexpr float kStopS = 0.01f, kReleaseS = 0.08f, kSettleSpeed = 0.06f;
// No step is shorter in time and as short in space: a foot that is so soon tracked where it stood never left.
constexpr float kNoStepS = 0.3f, kNoStepM = 0.03f;
constexpr float kMeanS = 1.0f;        // of the tracked place of a foot that stands
constexpr float kVelocityS = 0.03f;   // low-pass of the tracked velocity
constexpr float kFastest = 1.0f;      // m/s: a foot that comes to stand was no faster
constexpr float kFastestStart = 0.3f; // nor is one that starts: a tracker that throws a foot would send it backwards
constexpr float kLeastM = 1e-5f;

Vec3 at_most(const Vec3& velocity, float fastest) {
    const float speed = glm::length(velocity);
    return speed > fastest ? velocity * (fastest / speed) : velocity;
}

}  // namespace

/// Critically damped towards 0, exact for any interval; `rate`: one over the time constant of each axis.
void FootPin::spring(const Vec3& rate, float dt_s) {
    const Vec3 pull = glide_velocity_ + rate * glide_;
    const Vec3 fade = glm::exp(-rate * dt_s);
    glide_ = (glide_ + pull * dt_s) * fade;
    glide_velocity_ = (glide_velocity_ - rate * pull * dt_s) * fade;
}

Vec3 FootPin::update(const Vec3& tracked, bool planted, float floor_y, float dt_s) {
    drag_ = Vec3(0.0f);
    if (!known_) tracked_ = tracked;
    if (dt_s > 0.0f) {
        const Vec3 velocity = (tracked - tracked_) / dt_s;
        tracked_velocity_ += (velocity - tracked_velocity_) * (1.0f - std::exp(-dt_s / kVelocityS));
    }
    tracked_ = tracked;
    const Vec3 shown_velocity = glide_velocity_ + (planted_ ? Vec3(0.0f) : tracked_velocity_);
    if (planted && !planted_) {
        const Vec3 shown = tracked + glide_;
        const bool never_left = stood_s_ > 0.0f && free_s_ < kNoStepS && glm::length(tracked - tracked_there_) < kNoStepM;
        if (!never_left) {
            place_ = shown;
            stood_s_ = 0.0f;
        }
        glide_ = shown - place_;
        glide_velocity_ = known_ ? at_most(shown_velocity, kFastest) : Vec3(0.0f);
    } else if (!planted && planted_) {
        glide_ += place_ - tracked;
        glide_velocity_ -= at_most(tracked_velocity_, kFastestStart);
    }
    planted_ = planted;
    known_ = true;
    if (!planted) {
        free_s_ += dt_s;
        spring(Vec3(1.0f / kReleaseS), dt_s);
        if (glm::length(glide_) < kLeastM && glm::length(glide_velocity_) < kLeastM) glide_ = glide_velocity_ = Vec3(0.0f);
        offset_ = glide_;
        return tracked + offset_;
    }
    free_s_ = 0.0f;
    stood_s_ += dt_s;
    tracked_there_ = stood_s_ > dt_s ? glm::mix(tracked_there_, tracked, std::min(1.0f, dt_s / std::min(stood_s_, kMeanS))) : tracked;
    place_.y += std::clamp(floor_y - place_.y, -kSettleSpeed * dt_s, kSettleSpeed * dt_s);
    spring(Vec3(1.0f / kStopS), dt_s);
    offset_ = place_ + glide_ - tracked;
    const float length = glm::length(offset_);
    if (length > leash_m_) {
        drag_ = offset_ * (leash_m_ / length - 1.0f);
        offset_ += drag_;
        place_ += drag_;
    }
    return tracked + offset_;
}

}  // namespace vfit
