#include "motion/contact_features.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"

namespace vfit {

namespace {

enum Point { kAnkle = 0, kToes = 2, kKnee = 4, kHip = 6, kPelvis = 8 };
constexpr int kJoints[] = {VFIT_JOINT_LEFT_FOOT,  VFIT_JOINT_RIGHT_FOOT, VFIT_JOINT_LEFT_TOES,
                           VFIT_JOINT_RIGHT_TOES, VFIT_JOINT_LEFT_KNEE,  VFIT_JOINT_RIGHT_KNEE,
                           VFIT_JOINT_LEFT_HIP,   VFIT_JOINT_RIGHT_HIP};

constexpr float kStep_s = 1.0f / 30.0f;
constexpr float kFall_s = 0.1f, kRise = 0.02f;  // a level falls within this time and rises at that speed, m/s
constexpr float kTrembleShare = 0.2f, kTrembleRate = 0.03f;
constexpr float kLeastSpeed = 0.03f;  // m/s: slower is not told apart
constexpr float kMinMedianSpeed = 0.01f;
constexpr float kHeightScale = 20.0f;  // 5 cm are 1
constexpr float kPause_s = 0.5f;
constexpr float kUnevenM = 0.03f;  // the feet of a person who stands may be reported at heights so far apart

}  // namespace

void ContactFeatures::follow(Low& low, float height, float dt_s) {
    if (!low.known) {
        low = {true, height};
        return;
    }
    const float above = height - low.level;
    low.level += above < 0.0f ? above * (1.0f - std::exp(-dt_s / kFall_s)) : std::min(above, kRise * dt_s);
}

void ContactFeatures::update(const Body& body) {
    float dt_s =
        count_ > 0 ? static_cast<float>(seconds_between(history_[last_].time_ns, body.time_ns)) : 0.0f;
    if (count_ > 0 && (dt_s <= 0.0f || dt_s > kPause_s)) {
        // After a pause nothing is known of speeds; where the floor is stays known.
        count_ = 0;
        dt_s = 0.0f;
    }
    const Sample before = history_[last_];
    last_ = (last_ + 1) % kHistory;
    Sample& now = history_[last_];
    now = before;
    now.time_ns = body.time_ns;
    for (int i = 0; i < kPelvis; ++i) {
        const auto point = static_cast<size_t>(i);
        if (!body.has(kJoints[i])) continue;
        now.at[point] = body.at(kJoints[i]);
        if (!known_[point] && count_ > 0)
            for (Sample& sample : history_) sample.at[point] = now.at[point];
        known_[point] = true;
    }
    for (size_t side = 0; side < 2; ++side) {
        // Without toes the ankle stands for them, without a knee the middle of the leg.
        if (!known_[kToes + side]) now.at[kToes + side] = now.at[kAnkle + side];
        if (!known_[kKnee + side])
            now.at[kKnee + side] = 0.5f * (now.at[kHip + side] + now.at[kAnkle + side]);
        confidence_[side] = body.joints[static_cast<size_t>(kJoints[kAnkle + side])].confidence;
    }
    now.at[kPelvis] = 0.5f * (now.at[kHip] + now.at[kHip + 1]);
    count_ = std::min(count_ + 1, kHistory);
    for (size_t i = 0; i < lows_.size(); ++i)
        if (known_[kAnkle + i % 2]) follow(lows_[i], now.at[i].y, dt_s);
    // A foot held up for long must not become the floor.
    for (const size_t pair : {size_t{0}, size_t{2}})
        if (lows_[pair].known && lows_[pair + 1].known)
            for (size_t i = pair; i < pair + 2; ++i)
                lows_[i].level =
                    std::min(lows_[i].level, std::min(lows_[pair].level, lows_[pair + 1].level) + kUnevenM);
    for (size_t side = 0; side < 2 && dt_s > 0.0f; ++side) {
        const float speed = glm::length(now.at[kAnkle + side] - before.at[kAnkle + side]) / dt_s;
        // A running quantile: up by its share, down by the rest, so that it comes to rest where a fifth lies
        // below.
        float& quantile = tremble_[side];
        const float rate = kTrembleRate * dt_s / kStep_s;
        quantile *= std::exp(rate * (speed > quantile ? kTrembleShare : kTrembleShare - 1.0f));
        quantile = std::clamp(quantile, 0.005f, 1.0f);
    }
}

/// Where a point was so long ago, between readings on the line between them; before the first one, there.
Vec3 ContactFeatures::place(int point, float ago_s) const {
    const auto p = static_cast<size_t>(point);
    for (size_t k = 0; k + 1 < count_; ++k) {
        const Sample& newer = history_[(last_ + kHistory - k) % kHistory];
        const Sample& older = history_[(last_ + kHistory - k - 1) % kHistory];
        const double older_ago_s = seconds_between(older.time_ns, history_[last_].time_ns);
        if (older_ago_s < double{ago_s}) continue;
        const double newer_ago_s = seconds_between(newer.time_ns, history_[last_].time_ns);
        const float share = static_cast<float>((double{ago_s} - newer_ago_s) / (older_ago_s - newer_ago_s));
        return glm::mix(newer.at[p], older.at[p], std::clamp(share, 0.0f, 1.0f));
    }
    return history_[(last_ + kHistory - (count_ - 1)) % kHistory].at[p];
}

/// Of three readings, 1/30 s apart, from `first` such steps ago on: a single one that is off has no say.
Vec3 ContactFeatures::median_place(int point, int first) const {
    const auto at = [&](int step) { return place(point, kStep_s * static_cast<float>(step)); };
    const Vec3 a = at(first), b = at(first + 1), c = at(first + 2);
    return glm::max(glm::min(a, b), glm::min(glm::max(a, b), c));
}

float ContactFeatures::hip_speed() const {
    if (count_ < 2) return 0.0f;
    float most = 0.0f, before = place(kPelvis, 0.0f).y;
    for (int k = 1; k <= 3; ++k) {
        const float y = place(kPelvis, kStep_s * static_cast<float>(k)).y;
        most = std::max(most, std::abs(y - before) / kStep_s);
        before = y;
    }
    return most;
}

bool ContactFeatures::of(int side, std::span<float, kContactFeatureCount> out) const {
    if (count_ < 2 || !known_[static_cast<size_t>(kAnkle + side)]) return false;
    constexpr int kTimes = 5;
    std::array<std::array<Vec3, kTimes>, 5> at;  // ankle, toes, knee, other ankle, pelvis
    const int points[] = {kAnkle + side, kToes + side, kKnee + side, kAnkle + 1 - side, kPelvis};
    for (size_t p = 0; p < at.size(); ++p)
        for (int t = 0; t < kTimes; ++t)
            at[p][static_cast<size_t>(t)] = place(points[p], kStep_s * static_cast<float>(t));

    size_t n = 0;
    for (size_t lag = 0; lag < 3; ++lag) {
        const auto step = [&](size_t point) { return (at[point][lag] - at[point][lag + 1]) / kStep_s; };
        const auto two_steps = [&](size_t point) {
            return (at[point][lag] - at[point][lag + 2]) / (2 * kStep_s);
        };
        const float speeds[] = {glm::length(step(0)),      glm::length(step(1)), glm::length(two_steps(0)),
                                glm::length(two_steps(1)), glm::length(step(2)), glm::length(step(3))};
        for (const float speed : speeds) out[n++] = std::min(speed, 3.0f);
        for (size_t k = 0; k < 4; ++k) out[n++] = std::log(std::min(speeds[k], 3.0f) + kLeastSpeed);
        for (const size_t point : {size_t{0}, size_t{1}, size_t{4}})
            out[n++] = std::clamp(step(point).y, -3.0f, 3.0f);
        for (size_t k = 0; k < 2; ++k) {
            const float height = at[k][lag].y - lows_[2 * k + static_cast<size_t>(side)].level;
            out[n++] = std::clamp(kHeightScale * height, -2.0f, 8.0f);
        }
    }
    const auto s = static_cast<size_t>(side);
    for (size_t k = 0; k < 3; ++k) {
        const Vec3 now = median_place(points[k], 0), before = median_place(points[k], 3),
                   long_before = median_place(points[k], 6);
        const auto speed = [](const Vec3& from, const Vec3& to, int steps) {
            const float m_s = glm::length(to - from) / (kStep_s * static_cast<float>(steps));
            return std::log(std::min(m_s, 3.0f) + kMinMedianSpeed);
        };
        out[n++] = speed(before, now, 3);
        out[n++] = speed(long_before, now, 6);
        out[n++] = std::clamp((now.y - before.y) / (3.0f * kStep_s), -3.0f, 3.0f);
        out[n++] = k < 2 ? std::clamp(kHeightScale * (now.y - lows_[2 * k + s].level), -2.0f, 8.0f)
                         : speed(long_before, before, 3);
    }
    out[n++] = std::clamp(kHeightScale * (at[3][0].y - lows_[1 - s].level), -2.0f, 8.0f);
    out[n++] = std::log(tremble_[s]);
    out[n++] = std::log(tremble_[1 - s]);
    out[n++] = confidence_[s];
    out[n++] = known_[kToes + s] ? 1.0f : 0.0f;
    return true;
}

}  // namespace vfit
