#include "track/level.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "frame/floor.h"

namespace vfit {

namespace {

constexpr double kDoubt_s = 2.0;         // without anybody, after which up is doubted
constexpr float kBetter = 1.0f;         // logit by which another way has to be better
constexpr float kPerson = 3.0f;          // logit: upright people have 7 to 18, on their side below 6
constexpr uint32_t kEnough = 60;         // images: two seconds
constexpr float kStraightLeg = 0.985f;   // hip to foot over thigh and shank: 160 degrees
constexpr float kStraightTrunk = 0.966f;  // cosine of 15 degrees between legs and trunk
constexpr float kStride_m = 0.4f;

/// From the feet to the neck of somebody who stands upright; zero where the body does not say.
Vec3 axis_of(const Body& b) {
    constexpr std::array<int, 7> needed = {VFIT_JOINT_NECK,      VFIT_JOINT_LEFT_HIP,   VFIT_JOINT_RIGHT_HIP,
                                           VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_LEFT_FOOT,
                                           VFIT_JOINT_RIGHT_FOOT};
    for (const int j : needed)
        if (b.joints[size_t(j)].state != VFIT_JOINT_MEASURED) return Vec3(0.0f);
    const auto straight = [&](int hip, int knee, int foot) {
        return glm::length(b.at(hip) - b.at(foot)) >
               kStraightLeg * (glm::length(b.at(hip) - b.at(knee)) + glm::length(b.at(knee) - b.at(foot)));
    };
    if (!straight(VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT) ||
        !straight(VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT) ||
        glm::length(b.at(VFIT_JOINT_LEFT_FOOT) - b.at(VFIT_JOINT_RIGHT_FOOT)) > kStride_m)
        return Vec3(0.0f);
    const Vec3 feet = 0.5f * (b.at(VFIT_JOINT_LEFT_FOOT) + b.at(VFIT_JOINT_RIGHT_FOOT)),
               hips = 0.5f * (b.at(VFIT_JOINT_LEFT_HIP) + b.at(VFIT_JOINT_RIGHT_HIP)),
               legs = hips - feet, trunk = b.at(VFIT_JOINT_NECK) - hips;
    if (glm::dot(legs, trunk) < kStraightTrunk * glm::length(legs) * glm::length(trunk)) return Vec3(0.0f);
    return glm::normalize(legs + trunk);
}

}  // namespace

Vec3 Level::turned(const Vec3& up, int turns) {
    const float angle = 2.0f * kPi / float(kTurns) * float(turns);
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * up.x - s * up.y, s * up.x + c * up.y, up.z};
}

void Level::miss(int64_t time_ns) {
    if (sure()) {
        if (seconds_between(seen_ns_, time_ns) < kDoubt_s) return;
        agreed_ = 0;
    }
    constexpr int others[] = {kTurns / 4, -kTurns / 4, kTurns / 2};
    up_ = ++misses_ % 3 != 0 ? best_ : turned(best_, others[misses_ / 3 % std::size(others)]);
}

bool Level::compare(const Answers& person, bool floor_seen) {
    int best = 0;
    for (int k = 0; k < kTurns; k += floor_seen ? 2 : 1)
        if (person[size_t(k)] > person[size_t(best)]) best = k;
    const bool turn = person[size_t(best)] > std::max(kPerson, person[0] + kBetter);
    if (turn || up_ != best_) agreed_ = 0, stood_ = 0, has_sole_ = false;
    if (turn) up_ = turned(up_, best);
    best_ = up_;
    agreed_ += !turn && person[0] > kPerson;
    return !turn;
}

void Level::see(const Body& body, int64_t time_ns) {
    seen_ns_ = time_ns;
    if (stood_ >= kEnough) return;
    const Vec3 axis = axis_of(body);
    const bool stands = axis != Vec3(0.0f) && glm::dot(axis, up_) > 0.5f;
    if (has_sole_ && !stands) return;
    const auto sole = lowest_sole(body, up_);
    if (!sole) return;
    if (stands) {
        const float share = 1.0f / float(++stood_);
        axis_ = stood_ == 1 ? axis : axis_ + share * (axis - axis_);
        sole_ = stood_ == 1 ? *sole : sole_ + share * (*sole - sole_);
        up_ = best_ = glm::normalize(axis_);
    } else {
        sole_ = *sole;
    }
    has_sole_ = true;
}

void Level::follow(const Vec3& floor_normal) { up_ = best_ = floor_normal; }

void Level::place(Camera& camera) const {
    camera.floor_normal = up_;
    if (!has_sole_) return;
    camera.floor_distance_m = -glm::dot(up_, sole_);
    camera.floor_state = VFIT_FLOOR_ESTIMATED;
}

}  // namespace vfit
