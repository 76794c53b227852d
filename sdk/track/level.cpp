#include "track/level.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "frame/floor.h"

namespace vfit {

namespace {

constexpr double kDoubt_s = 2.0;  // without a person, after which up is doubted
// Logits. Upright people have 7 to 18, those on their side or head below 7, and 4 less than upright ones.
constexpr float kPerson = 5.0f, kBetter = 3.0f;
constexpr float kPartly = 2.0f;  // of a person who is partly out of view, if no other way comes near
constexpr uint32_t kAtFirst = 10, kNowAndThen = 15;  // images: all ways are tried on each; on one of so many
constexpr uint32_t kEnough = 60;                     // images: two seconds
constexpr float kLegs = 0.9f;                        // hip to foot over thigh and shank: who sits has others
constexpr float kStride_m = 0.5f;
constexpr float kPressure = 0.35f;  // from the ankle to the ball of the foot: Winter 1995, 4 to 5 cm

/// The way from the feet up to the centre of mass, zero where the body does not say. A person who stands is
/// in balance: whatever the posture, their centre of mass is above the middle of the pressure below their
/// feet.
Vec3 balance_of(const Body& b) {
    // Shares of mass: Winter 2009, table 4.1, each at a place between two joints.
    struct Part {
        int from, to;
        float along, mass;
    };
    constexpr Part kParts[] = {{VFIT_JOINT_PELVIS, VFIT_JOINT_NECK, 0.5f, 0.497f},
                               {VFIT_JOINT_NECK, VFIT_JOINT_HEAD, 1.0f, 0.081f},
                               {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_HAND, 0.5f, 0.05f},
                               {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_HAND, 0.5f, 0.05f},
                               {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE, 0.43f, 0.1f},
                               {VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE, 0.43f, 0.1f},
                               {VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT, 0.6f, 0.061f},
                               {VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT, 0.6f, 0.061f}};
    Vec3 centre(0.0f), below(0.0f);
    for (const Part& part : kParts) {
        if (!b.has(part.from) || !b.has(part.to)) return Vec3(0.0f);
        centre += part.mass * glm::mix(b.at(part.from), b.at(part.to), part.along);
    }
    const auto leg = [&](int hip, int knee, int foot, int toes) {
        below += 0.5f * glm::mix(b.at(foot), b.at(toes), kPressure);
        return b.joints[size_t(foot)].state == VFIT_JOINT_MEASURED && b.has(toes) &&
               glm::length(b.at(hip) - b.at(foot)) >
                   kLegs * (glm::length(b.at(hip) - b.at(knee)) + glm::length(b.at(knee) - b.at(foot)));
    };
    const bool left =
                   leg(VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_LEFT_TOES),
               right = leg(VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT,
                           VFIT_JOINT_RIGHT_TOES);
    if (!left || !right || glm::length(b.at(VFIT_JOINT_LEFT_FOOT) - b.at(VFIT_JOINT_RIGHT_FOOT)) > kStride_m)
        return Vec3(0.0f);
    return glm::normalize(centre - below);
}

}  // namespace

Vec3 Level::turned(const Vec3& up, int turns) {
    const float angle = 2.0f * kPi / float(kTurns) * float(turns);
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * up.x - s * up.y, s * up.x + c * up.y, up.z};
}

bool Level::miss(int64_t time_ns) {
    if (sure()) {
        const bool restarted = time_ns < seen_ns_;
        if (!restarted && seconds_between(seen_ns_, time_ns) < kDoubt_s) return false;
        agreed_ = 0, misses_ = 0, stood_ = 0;  // the camera may have been moved
    }
    if (way_ == 0) {
        all_ = weak_now_ || misses_ < kAtFirst || misses_ % kNowAndThen == 0;
        if (!weak_now_) weak_ = 0;
        weak_now_ = false;
    }
    way_ = all_ && way_ < kTurns ? way_ + 1 : 0;
    up_ = turned(best_, way_);
    misses_ += way_ == 0;
    return way_ != 0;
}

bool Level::compare(const Answers& person) {
    const auto best = std::max_element(person.begin(), person.end());
    const bool turn = *best > std::max(kPerson, person[0] + kBetter);
    const float others = *std::max_element(person.begin() + 1, person.end());
    const bool is_up =
        !turn && (person[0] > kPerson || (person[0] > kPartly && person[0] > others + kBetter));
    if (turn || (is_up && way_ % kTurns != 0)) {
        up_ = best_ = turned(up_, turn ? int(best - person.begin()) : 0);
        agreed_ = 0, stood_ = 0, has_sole_ = false;
    }
    agreed_ += !turn && person[0] > kPerson;
    if (turn || is_up) {
        way_ = 0;
        return is_up;
    }
    // Another way may show a person better. If none does, a weak answer has to do.
    weak_now_ = way_ == 0 && weak_ < kAtFirst;
    if (weak_now_ || way_ % kTurns != 0) return false;
    ++weak_;
    way_ = 0;
    return true;
}

void Level::keep(const Vec3& up) { up_ = best_ = up, way_ = 0; }

void Level::see(const Body& body, int64_t time_ns) {
    seen_ns_ = time_ns;
    if (stood_ >= kEnough) return;
    const Vec3 axis = balance_of(body);
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
