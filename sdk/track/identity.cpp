#include "track/identity.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"

namespace vfit {

namespace {

constexpr float kRemembered_s = 2.5f;  // a short exit, or a moment behind something
constexpr float kStep_m = 0.5f;        // that is not foreseen
constexpr float kReach_m = 1.2f;       // from the trunk to the fingertips, and a step
constexpr float kWalk_mps = 1.2f;      // while away: comfortable walking speed is 1.2 to 1.4 m/s
constexpr float kGrown_m = 0.3f;       // arms up excepted: a head's height and more
constexpr float kMoment_s = 1.0f;      // behind somebody who passes
constexpr float kHidden = 0.3f;  // of the usual area is seen, at most: another part may come out elsewhere
constexpr float kUsualShare = 0.1f;  // of the newest height and area in the usual ones
constexpr float kSpeedShare = 0.3f;  // of the newest velocity in the kept one
constexpr float kFastest_mps = 4.0f;
constexpr float kForesight_s = 0.3f;  // beyond, people turn
constexpr uint32_t kIds = 254;

}  // namespace

bool Identity::within_reach(uint32_t slot, const Vec3& p) const {
    const Vec3 away = p - tracks_[slot].centre;
    return away.x * away.x + away.z * away.z < kReach_m * kReach_m;
}

Vec3 Identity::foreseen(const PersonTrack& t, int64_t time_ns) const {
    return t.centre + t.velocity * std::min(float(seconds_between(t.seen_ns, time_ns)), kForesight_s);
}

uint32_t Identity::hidden_near(const Shape& shape, float nearer_than_m, int64_t time_ns) const {
    uint32_t best = kMost;
    for (uint32_t i = 0; i < kMost; ++i) {
        const PersonTrack& t = tracks_[i];
        if (t.id == 0 || t.seen || seconds_between(t.seen_ns, time_ns) > kMoment_s) continue;
        const float distance = floor_distance(shape.centre, foreseen(t, time_ns));
        if (distance > std::min(nearer_than_m, kStep_m)) continue;
        nearer_than_m = distance;
        best = i;
    }
    return best;
}

void Identity::reset() {
    tracks_ = {};
    last_id_ = 0;
}

void Identity::begin(int64_t time_ns) {
    for (PersonTrack& t : tracks_) {
        t.seen = false;
        // A source that starts again tells earlier times: nobody of before is in it.
        const double away_s = seconds_between(t.seen_ns, time_ns);
        if (t.id != 0 && (away_s > kRemembered_s || away_s < 0.0)) t = {};
    }
}

uint32_t Identity::adopt(const Shape& shape, int64_t time_ns) {
    uint32_t best = kMost, free = kMost;
    float least = 1e9f;
    for (uint32_t i = 0; i < kMost; ++i) {
        const PersonTrack& t = tracks_[i];
        if (t.id == 0) {
            free = std::min(free, i);
            continue;
        }
        if (t.seen && t.area_m2 > kHidden * t.usual_area_m2) continue;
        const float away_s = float(seconds_between(t.seen_ns, time_ns));
        const float distance = floor_distance(shape.centre, foreseen(t, time_ns));
        // Who comes from behind something shows an arm first, but nobody has grown.
        const float taller = shape.high_m - t.height_m;
        if (distance > kStep_m + kWalk_mps * away_s || taller > kGrown_m) continue;
        const float cost = distance + std::abs(taller);
        if (cost < least) {
            least = cost;
            best = i;
        }
    }
    if (best == kMost && free < kMost) {
        // Numbers go round, so that a number that has just become free is not given to somebody else.
        bool used = true;
        while (used) {
            last_id_ = last_id_ % kIds + 1;
            used =
                std::any_of(tracks_.begin(), tracks_.end(), [&](const auto& t) { return t.id == last_id_; });
        }
        best = free;
        tracks_[best] = {};
        tracks_[best].id = last_id_;
        tracks_[best].first_ns = time_ns;
    }
    return best;
}

void Identity::see(uint32_t slot, const Shape& shape, int64_t time_ns) {
    PersonTrack& t = tracks_[slot];
    const float dt_s = float(seconds_between(t.seen_ns, time_ns));
    if (t.cells > 0 && dt_s > 1e-3f && dt_s < 1.0f) {
        Vec3 velocity = (shape.centre - t.centre) / dt_s;
        if (const float speed = glm::length(velocity); speed > kFastest_mps) velocity *= kFastest_mps / speed;
        t.velocity += kSpeedShare * (velocity - t.velocity);
    } else if (dt_s >= 1.0f) {
        t.velocity = Vec3(0.0f);
    }
    t.centre = shape.centre;
    // Who is nearly hidden keeps the height and area of before.
    if (t.cells == 0) {
        t.height_m = shape.high_m;
        t.usual_area_m2 = shape.area_m2;
    } else if (shape.area_m2 > kHidden * t.usual_area_m2) {
        t.height_m += kUsualShare * (shape.high_m - t.height_m);
        t.usual_area_m2 += kUsualShare * (shape.area_m2 - t.usual_area_m2);
    }
    t.area_m2 = shape.area_m2;
    t.cells = shape.cells;
    t.seen_ns = time_ns;
    t.seen = true;
}

}  // namespace vfit
