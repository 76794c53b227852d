#include "track/joint_steady.h"

#include <algorithm>

#include "core/clock.h"

namespace vfit {

namespace {

constexpr float kLeastCutoff_hz = 3.0f;   // at rest: little trembling, 50 ms of lag
constexpr float kCutoffPerSpeed = 12.0f;  // Hz for each m/s: a moving joint is hardly held back
constexpr float kSpeedCutoff_hz = 4.0f;
constexpr float kSure = 0.6f;  // confidence from which a place counts in full
constexpr float kLongestGap_s = 0.5f;

float share(float cutoff_hz, float dt) {
    const float t = 2.0f * kPi * cutoff_hz * dt;
    return t / (t + 1.0f);
}

}  // namespace

void JointSteady::run(int64_t time_ns, SeenJoints& joints) {
    for (size_t j = 0; j < joints.size(); ++j) {
        if (joints[j].confidence <= 0.0f) continue;
        Channel& c = channels_[j];
        const float dt = float(seconds_between(c.seen_ns, time_ns));
        if (!c.known || dt <= 0.0f || dt > kLongestGap_s) {
            c = {joints[j].position, Vec3(0.0f), time_ns, true};
            continue;
        }
        c.seen_ns = time_ns;
        const float trust = std::clamp(joints[j].confidence / kSure, 0.05f, 1.0f);
        const Vec3 speed = (joints[j].position - c.place) / dt;
        c.speed += trust * share(kSpeedCutoff_hz, dt) * (speed - c.speed);
        const float cutoff = kLeastCutoff_hz + kCutoffPerSpeed * glm::length(c.speed);
        c.place += trust * share(cutoff, dt) * (joints[j].position - c.place);
        joints[j].position = c.place;
    }
}

}  // namespace vfit
