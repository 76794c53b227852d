#include "motion/foot_contact.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "motion/contact_network.h"

namespace vfit {

namespace {

// The network's chance to stand: planted above the first; free below the second for two bodies in a row, or
// below the third at once.
constexpr float kPlantChance = 0.5f, kFreeChance = 0.4f, kSurelyFreeChance = 0.1f;
constexpr float kNeverStandsM = 0.12f;  // so high above where it stands: at the top of a jump it is slow, too
// Whoever leaves the floor with both feet has pushed off: hips that move up or down slower than that carry
// nobody.
constexpr float kFlightSpeed = 0.35f;  // m/s
constexpr float kHeldUnseenS = 0.4f;   // a foot that is hidden stays as it was for so long

// Thresholds of common practice for marker-less ankles: a foot is planted when lower and slower than the
// first of each pair for two frames of 1/30 s, and free when higher or faster than the second. The paper's
// line 10 waits for both and so holds a foot that slides.
constexpr float kPlantHeightM = 0.04f, kFreeHeightM = 0.06f;
constexpr float kPlantSpeed = 0.15f, kFreeSpeed = 0.30f;  // m/s
constexpr float kPlantTimeS = 0.05f;                      // between one and two intervals of 30 Hz
// A sensor whose planted feet move: thresholds of speed grow with that noise, up to twofold.
constexpr float kQuietSpeed = 0.075f, kMostSpeedScale = 2.0f;
constexpr float kNoiseTimeS = 2.0f;
constexpr float kSpeedTimeS = 0.05f;  // low-pass of the finite-difference velocity
// The level falls to a lower ankle at once (but not on one bad frame) and forgets it slowly.
constexpr float kLevelFallTimeS = 0.1f, kLevelRise = 0.02f;  // s, m/s
// The two ankles of a person who stands may be reported at heights so far apart, metres.
constexpr float kUnevenM = 0.03f;
constexpr float kPauseS = 0.5f;  // a longer pause between bodies says nothing about speed

constexpr int kAnkles[2] = {VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_RIGHT_FOOT};

float share(float dt_s, float time_s) { return 1.0f - std::exp(-dt_s / time_s); }

}  // namespace

void FootContact::reset() { *this = FootContact(); }

float FootContact::lowest_level() const {
    float level = 0.0f;
    bool any = false;
    for (const Foot& foot : feet_)
        if (foot.known) {
            level = any ? std::min(level, foot.level) : foot.level;
            any = true;
        }
    return level;
}

void FootContact::follow(Foot& foot, const Vec3& ankle, float dt_s) {
    const Vec3 velocity = (ankle - foot.position) / dt_s;
    foot.velocity += (velocity - foot.velocity) * share(dt_s, kSpeedTimeS);
    foot.position = ankle;
    const float above = ankle.y - foot.level;
    foot.level += above < 0 ? above * share(dt_s, kLevelFallTimeS) : std::min(above, kLevelRise * dt_s);
}

bool FootContact::by_thresholds(Foot& foot, float dt_s) const {
    const float height = foot.position.y - foot.level;
    const float speed = glm::length(foot.velocity);
    const float scale = std::clamp(foot.planted_speed / kQuietSpeed, 1.0f, kMostSpeedScale);
    if (foot.planted) {
        foot.planted_speed += (speed - foot.planted_speed) * share(dt_s, kNoiseTimeS);
        foot.low_time_s = 0;
        return height <= kFreeHeightM && speed <= kFreeSpeed * scale;
    }
    foot.low_time_s = height < kPlantHeightM && speed < kPlantSpeed * scale ? foot.low_time_s + dt_s : 0.0f;
    return foot.low_time_s > kPlantTimeS;
}

bool FootContact::by_network(Foot& foot, int side) const {
    std::array<float, kContactFeatureCount> features;
    if (foot.position.y - foot.level > kNeverStandsM) return false;
    if (!features_.of(side, features)) return foot.planted;
    const float before = foot.chance;
    foot.chance = chance_to_stand(features);
    if (!foot.planted) return foot.chance > kPlantChance;
    return foot.chance > kFreeChance || (before > kFreeChance && foot.chance > kSurelyFreeChance);
}

/// Legs that a tracker takes for one another both seem to step.
void FootContact::keep_one_down(bool stands[2]) const {
    const bool before = feet_[0].planted || feet_[1].planted;
    if (stands[0] || stands[1] || !before || features_.hip_speed() > kFlightSpeed) return;
    if (feet_[0].planted && feet_[1].planted)
        stands[feet_[0].chance > feet_[1].chance ? 0 : 1] = true;
    else
        stands[feet_[0].planted ? 0 : 1] = true;
}

/// By the ankles that stand, without one that is higher than that of a whole foot: its foot is on its ball.
/// In the first body by the lowest.
void FootContact::find_floor(const Body& body, float dt_s) {
    float lowest = INFINITY;
    for (size_t side = 0; side < 2; ++side)
        if (feet_[side].planted && body.has(kAnkles[side]))
            lowest = std::min(lowest, body.at(kAnkles[side]).y);
    if (lowest == INFINITY) return;
    const float uneven_m = started_ ? kUnevenM : 0.0f;
    float sum = 0.0f, count = 0.0f;
    for (size_t side = 0; side < 2; ++side)
        if (feet_[side].planted && body.has(kAnkles[side]) && body.at(kAnkles[side]).y <= lowest + uneven_m) {
            sum += body.at(kAnkles[side]).y;
            count += 1.0f;
        }
    standing_.update(sum / count, dt_s);
}

void FootContact::update(const Body& body, vfit_contact_rule rule) {
    const float dt_s = static_cast<float>(seconds_between(time_ns_, body.time_ns));
    const bool pause = !started_ || dt_s > kPauseS || dt_s <= 0.0f;
    features_.update(body);
    bool stands[2];
    for (int side = 0; side < 2; ++side) {
        Foot& foot = feet_[static_cast<size_t>(side)];
        if (!body.has(kAnkles[side])) {
            foot.unseen_s += std::max(0.0f, dt_s);
            if (pause || foot.unseen_s > kHeldUnseenS) foot.planted = foot.known = false;
            stands[side] = foot.planted;
            continue;
        }
        foot.unseen_s = 0.0f;
        const Vec3& ankle = body.at(kAnkles[side]);
        if (!foot.known || pause) {
            const float speed = foot.planted_speed;
            foot = Foot();
            foot.known = true;
            foot.position = ankle;
            foot.level = ankle.y;
            foot.planted_speed = speed;
            // The first frame decides by height alone, as lines 1-7 of Algorithm 5.
            const int other = kAnkles[1 - side];
            foot.planted = stands[side] =
                pause && (!body.has(other) || ankle.y < body.at(other).y + kPlantHeightM);
            continue;
        }
        follow(foot, ankle, dt_s);
        stands[side] = rule == VFIT_CONTACT_THRESHOLDS ? by_thresholds(foot, dt_s) : by_network(foot, side);
    }
    if (rule == VFIT_CONTACT_LEARNT) keep_one_down(stands);
    switched_ = false;
    for (size_t side = 0; side < 2; ++side) {
        switched_ = switched_ || (stands[side] && !feet_[side].planted);
        feet_[side].planted = stands[side];
    }
    // A foot held up for long must not become the floor: its level stays near the lower one.
    const float lowest = lowest_level();
    for (Foot& foot : feet_)
        if (foot.known) foot.level = std::min(foot.level, lowest + kUnevenM);
    find_floor(body, pause ? 0.0f : dt_s);
    started_ = true;
    time_ns_ = body.time_ns;
}

}  // namespace vfit
