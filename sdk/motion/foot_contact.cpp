#include "motion/foot_contact.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Thresholds of common practice for marker-less ankles: a foot is planted when lower and slower than the
// first of each pair for two frames of 1/30 s, and free when higher or faster than the second.
constexpr float kPlantHeightM = 0.04f, kFreeHeightM = 0.06f;
constexpr float kPlantSpeed = 0.15f, kFreeSpeed = 0.30f;  // m/s
constexpr float kPlantTimeS = 0.05f;  // between one and two intervals of 30 Hz
// A sensor whose planted feet move: thresholds of speed grow with that noise, up to twofold.
constexpr float kQuietSpeed = 0.075f, kMostSpeedScale = 2.0f;
constexpr float kNoiseTimeS = 2.0f;
constexpr float kSpeedTimeS = 0.05f;  // low-pass of the finite-difference velocity
// The level falls to a lower ankle at once (but not on one bad frame) and forgets it slowly.
constexpr float kLevelFallTimeS = 0.1f, kLevelRise = 0.02f;  // s, m/s
// The two ankles of a person who stands may be reported at heights so far apart, metres.
constexpr float kUnevenM = 0.03f;
constexpr float kPauseS = 0.5f;  // a longer pause between bodies says nothing about speed

float share(float dt_s, float time_s) { return 1.0f - std::exp(-dt_s / time_s); }

}  // namespace

void FootContact::reset() { *this = FootContact(); }

float FootContact::ankle_level(float otherwise) const {
    float level = otherwise;
    bool any = false;
    for (const Foot& foot : feet_)
        if (foot.known) {
            level = any ? std::min(level, foot.level) : foot.level;
            any = true;
        }
    return level;
}

void FootContact::update_foot(Foot& foot, const Vec3& ankle, float dt_s) {
    const Vec3 velocity = (ankle - foot.position) / dt_s;
    foot.velocity += (velocity - foot.velocity) * share(dt_s, kSpeedTimeS);
    foot.position = ankle;
    const float above = ankle.y - foot.level;
    foot.level += above < 0 ? above * share(dt_s, kLevelFallTimeS) : std::min(above, kLevelRise * dt_s);

    const float height = ankle.y - foot.level;
    const float speed = glm::length(foot.velocity);
    const float scale = std::clamp(foot.planted_speed / kQuietSpeed, 1.0f, kMostSpeedScale);
    if (foot.planted) {
        foot.planted_speed += (speed - foot.planted_speed) * share(dt_s, kNoiseTimeS);
        foot.planted = height <= kFreeHeightM && speed <= kFreeSpeed * scale;
        foot.low_time_s = 0;
        return;
    }
    foot.low_time_s = height < kPlantHeightM && speed < kPlantSpeed * scale ? foot.low_time_s + dt_s : 0.0f;
    if (foot.low_time_s > kPlantTimeS) {
        foot.planted = true;
        switched_ = true;
    }
}

void FootContact::update(const Vec3 ankles[2], const bool known[2], int64_t time_ns) {
    const float dt_s = static_cast<float>(static_cast<double>(time_ns - time_ns_) * 1e-9);
    const bool pause = !started_ || dt_s > kPauseS || dt_s <= 0.0f;
    switched_ = false;
    for (int side = 0; side < 2; ++side) {
        Foot& foot = feet_[static_cast<size_t>(side)];
        if (!known[side]) {
            foot.planted = false;
            foot.known = false;
            continue;
        }
        if (!foot.known || pause) {
            const float speed = foot.planted_speed;
            foot = Foot();
            foot.known = true;
            foot.position = ankles[side];
            foot.level = ankles[side].y;
            foot.planted_speed = speed;
            // The first frame decides by height alone, as lines 1-7 of Algorithm 5.
            const int other = 1 - side;
            foot.planted = pause && (!known[other] || ankles[side].y < ankles[other].y + kPlantHeightM);
            continue;
        }
        update_foot(foot, ankles[side], dt_s);
    }
    // A foot held up for long must not become the floor: its level stays near the lower one.
    const float lowest = ankle_level(0.0f);
    for (Foot& foot : feet_)
        if (foot.known) foot.level = std::min(foot.level, lowest + kUnevenM);
    started_ = true;
    time_ns_ = time_ns;
}

}  // namespace vfit
