#include "motion/adaptive_filter.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr int kRests = 0;
// White acceleration of each mode, m/s^2 over a frame of 1/30 s. Who rests only drifts, as the sway of a
// standing body does: metres per square root of a second. These and what follows: searched for on made noise
// at rest, swings and reaches, and on real Kinect v2 streams (vfit-bench motion --only filters).
constexpr float kAcceleration[AdaptiveFilter::kModes] = {0.0f, 0.05f, 15.0f};
constexpr float kFrame_s = 1.0f / 30.0f;
constexpr float kDrift = 0.0002f;
constexpr float kRestingSpeed = 0.105f;  // m/s: sd of the velocity of who rests, should he start to move
// Chance that a mode gives way to another one within a frame, from a row to a column.
constexpr float kSwitch[AdaptiveFilter::kModes][AdaptiveFilter::kModes] = {
    {0.9989f, 0.0006f, 0.0005f}, {0.03f, 0.96f, 0.01f}, {0.001f, 0.03f, 0.969f}};

// Readings of trackers wander slowly beside their white noise, which differences do not show: the least noise
// stands for that.
constexpr float kLeastNoiseM = 0.0075f, kLeastWhiteM = 0.002f, kMostNoiseM = 0.05f;
constexpr float kEvenTimes = 1.3f;  // intervals that differ by less are even
constexpr float kMedianOfNormal = 0.6745f;
constexpr float kLeap = 18.0f;     // squared Mahalanobis distance: 0.04 % of honest readings lie farther
constexpr float kSameSide = 0.5f;  // cosine
constexpr float kEvidence = 3.0f;  // of the white noise's length

Vec3 squared(const Vec3& v) { return v * v; }

}  // namespace

void AdaptiveFilter::start(const Vec3& reading, const Vec3& velocity, float noise_scale) {
    const Vec3 variance = squared(noise_m() * noise_scale);
    for (Mode& m : modes_) {
        m = Mode();
        m.place = reading;
        m.velocity = velocity;
        m.pp = variance;
        m.vv = 2.0f * variance / (kFrame_s * kFrame_s);
    }
    modes_[kRests].velocity = Vec3(0.0f);
    modes_[kRests].vv = Vec3(kRestingSpeed * kRestingSpeed);
    const bool moves = velocity != Vec3(0.0f);
    modes_[0].probability = moves ? 0.05f : 0.6f;
    modes_[1].probability = moves ? 0.15f : 0.3f;
    modes_[2].probability = moves ? 0.8f : 0.1f;
    position_ = reading;
    velocity_ = velocity;
}

/// The third difference of even readings is noise alone for whatever moves smoothly; its sd is sqrt(20) times
/// theirs. A running median, so that throws and outliers do not count.
void AdaptiveFilter::learn_noise(const Vec3& reading, float dt_s) {
    const bool even = dt_s < kEvenTimes * last_dt_s_ && last_dt_s_ < kEvenTimes * dt_s;
    even_count_ = even ? even_count_ + 1 : 0;
    if (even_count_ >= 2) {
        noise_count_ = std::min(noise_count_ + 1, 60);
        const float rate = std::max(0.02f, 0.6f / static_cast<float>(noise_count_));
        const Vec3 third =
            (reading - 3.0f * readings_[0] + 3.0f * readings_[1] - readings_[2]) / std::sqrt(20.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const bool above = std::abs(third[axis]) > kMedianOfNormal * white_[axis];
            white_[axis] = std::clamp(white_[axis] * (above ? 1.0f + rate : 1.0f / (1.0f + rate)),
                                      kLeastWhiteM, kMostNoiseM);
        }
    }
    readings_ = {reading, readings_[0], readings_[1]};
    last_dt_s_ = dt_s;
}

Vec3 AdaptiveFilter::noise_m() const { return glm::max(white_, Vec3(kLeastNoiseM)); }

void AdaptiveFilter::mix() {
    std::array<Mode, kModes> mixed;
    for (int j = 0; j < kModes; ++j) {
        Mode& to = mixed[static_cast<size_t>(j)];
        float weights[kModes];
        for (int i = 0; i < kModes; ++i) {
            weights[i] = kSwitch[i][j] * modes_[static_cast<size_t>(i)].probability;
            to.probability += weights[i];
        }
        for (int i = 0; i < kModes; ++i) {
            const Mode& from = modes_[static_cast<size_t>(i)];
            weights[i] /= to.probability;
            to.place += weights[i] * from.place;
            to.velocity += weights[i] * from.velocity;
        }
        for (int i = 0; i < kModes; ++i) {
            const Mode& from = modes_[static_cast<size_t>(i)];
            const Vec3 p = from.place - to.place, v = from.velocity - to.velocity;
            to.pp += weights[i] * (from.pp + p * p);
            to.pv += weights[i] * (from.pv + p * v);
            to.vv += weights[i] * (from.vv + v * v);
        }
    }
    modes_ = mixed;
}

void AdaptiveFilter::predict(float dt_s) {
    Mode& rests = modes_[kRests];
    rests.velocity = Vec3(0.0f);
    rests.pp += kDrift * kDrift * dt_s;
    rests.pv = Vec3(0.0f);
    rests.vv = Vec3(kRestingSpeed * kRestingSpeed);
    for (int i = 1; i < kModes; ++i) {
        Mode& m = modes_[static_cast<size_t>(i)];
        // Acceleration that is white over a frame: its power by time is a^2 * frame.
        const float power = kAcceleration[i] * kAcceleration[i] * kFrame_s;
        m.place += dt_s * m.velocity;
        m.pp += dt_s * (2.0f * m.pv + dt_s * m.vv) + power * dt_s * dt_s * dt_s / 3.0f;
        m.pv += dt_s * m.vv + power * dt_s * dt_s / 2.0f;
        m.vv += power * dt_s;
    }
}

/// Far from where a joint that rests or coasts would be, or turns if that is what it does. Twice on the same
/// side is no error but a motion.
bool AdaptiveFilter::leaps(const Vec3& reading, const Vec3& variance) const {
    float nearest = 1e30f;
    for (int i = 0; i < kModes - 1; ++i) {
        const Mode& m = modes_[static_cast<size_t>(i)];
        const Vec3 d = squared(reading - m.place) / (m.pp + variance);
        nearest = std::min(nearest, d.x + d.y + d.z);
    }
    const Mode& turns = modes_[kModes - 1];
    if (turns.probability > 0.5f) {
        const Vec3 d = squared(reading - turns.place) / (turns.pp + variance);
        nearest = std::min(nearest, d.x + d.y + d.z);
    }
    return nearest > kLeap;
}

/// The reading before, so far beside the joint as noise hardly lies, says that a leap to the same side is
/// none.
bool AdaptiveFilter::is_evidence(const Vec3& before) const {
    const float far = glm::length(before), leap = glm::length(beside_);
    return far > kEvidence * glm::length(white_) && glm::dot(before, beside_) > kSameSide * far * leap;
}

void AdaptiveFilter::correct(const Vec3& reading, const Vec3& variance) {
    float logs[kModes], most = -1e30f;
    for (int i = 0; i < kModes; ++i) {
        Mode& m = modes_[static_cast<size_t>(i)];
        const Vec3 s = m.pp + variance, innovation = reading - m.place;
        const Vec3 d = squared(innovation) / s;
        logs[i] =
            -0.5f * (d.x + d.y + d.z + std::log(s.x * s.y * s.z)) + std::log(std::max(m.probability, 1e-12f));
        most = std::max(most, logs[i]);
        const Vec3 gain_p = m.pp / s, gain_v = m.pv / s;
        m.place += gain_p * innovation;
        m.velocity += gain_v * innovation;
        m.vv -= gain_v * m.pv;
        m.pv -= gain_p * m.pv;
        m.pp -= gain_p * m.pp;
    }
    float sum = 0.0f;
    for (int i = 0; i < kModes; ++i)
        sum += modes_[static_cast<size_t>(i)].probability = std::exp(logs[i] - most);
    for (Mode& m : modes_) m.probability = std::max(m.probability / sum, 1e-5f);
}

void AdaptiveFilter::combine() {
    position_ = velocity_ = Vec3(0.0f);
    float sum = 0.0f;
    for (const Mode& m : modes_) {
        position_ += m.probability * m.place;
        velocity_ += m.probability * m.velocity;
        sum += m.probability;
    }
    position_ /= sum;
    velocity_ /= sum;
}

void AdaptiveFilter::update(const Vec3& reading, float noise_scale, float dt_s) {
    if (count_ == 0) {
        count_ = 1;
        white_ = Vec3(kLeastNoiseM);
        readings_.fill(reading);
        start(reading, Vec3(0.0f), noise_scale);
        return;
    }
    const Vec3 before = beside_, from = readings_[0];
    beside_ = reading - position_;
    learn_noise(reading, dt_s);
    const Vec3 variance = squared(noise_m() * noise_scale);
    mix();
    predict(dt_s);
    if (!leaps(reading, variance)) {
        correct(reading, variance);
    } else if (is_evidence(before)) {
        start(reading, (reading - from) / dt_s, noise_scale);
        return;
    }
    combine();
}

}  // namespace vfit
