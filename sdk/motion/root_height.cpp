#include "motion/root_height.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kKneeSd = 0.09f;      // rad, of a tracked knee
constexpr float kLengthSdM = 0.004f;  // of a leg, beside that
constexpr float kSlopeSdM = 0.03f;    // of one hip above the other
constexpr float kJumpS = 0.05f;       // in a few of these the root follows other feet

float square(float x) { return x * x; }

}  // namespace

HeightVote standing_vote(const Leg& tracked, const Vec3& target) {
    const float length_m = tracked.length();
    const float upper_m = tracked.rest->upper_m, lower_m = tracked.rest->lower_m;
    const Vec3 way = target - tracked.hip;
    HeightVote vote;
    vote.rise_m = way.y + std::sqrt(std::max(square(length_m) - square(way.x) - square(way.z), 0.0f));
    // length^2 = upper^2 + lower^2 + 2 upper lower cos(bend): how the length changes with the bend.
    const float cosine =
        (square(length_m) - square(upper_m) - square(lower_m)) / std::max(2.0f * upper_m * lower_m, 1e-6f);
    const float sine = std::sqrt(std::max(0.0f, 1.0f - square(cosine)));
    const float slope_m = upper_m * lower_m * sine / std::max(length_m, 1e-3f);
    vote.sd_m = std::hypot(kLengthSdM, kKneeSd * slope_m);
    return vote;
}

void RootHeight::update(const HeightVote votes[2], const bool stands[2], float dt_s) {
    // Least squares of both votes and of hips that are level.
    const float variance[2] = {square(votes[0].sd_m), square(votes[1].sd_m)};
    const float slope_m = (votes[0].rise_m - votes[1].rise_m) * square(kSlopeSdM) /
                          (square(kSlopeSdM) + variance[0] + variance[1]);
    const float lift_m = (variance[1] * (votes[0].rise_m - 0.5f * slope_m) +
                          variance[0] * (votes[1].rise_m + 0.5f * slope_m)) /
                         (variance[0] + variance[1]);
    if (known_ && (stands[0] != stands_[0] || stands[1] != stands_[1])) {
        // The root goes on with a foot that stands on.
        float change_m = 0.0f;
        for (int side = 0; side < 2; ++side)
            if (stands[side] && stands_[side]) change_m = votes[side].rise_m - rise_m_[side];
        jump_ = Glide(Vec3(lift_m_ + change_m - lift_m, slope_m_ - slope_m, 0.0f));
    } else {
        jump_.fade(kJumpS, dt_s);
    }
    known_ = true;
    for (int side = 0; side < 2; ++side) {
        stands_[side] = stands[side];
        rise_m_[side] = votes[side].rise_m;
    }
    lift_m_ = lift_m + jump_.value().x;
    slope_m_ = slope_m + jump_.value().y;
}

}  // namespace vfit
