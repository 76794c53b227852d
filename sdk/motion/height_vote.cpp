#include "motion/height_vote.h"

#include <algorithm>
#include <cmath>

#include "motion/glide.h"

namespace vfit {

namespace {

constexpr float kWeightS = 0.35f;    // time constant with which a foot gains and loses its say
constexpr float kFreeWeight = 0.1f;  // of a foot that stands: trackers lose a leg that swings
constexpr float kJumpS = 0.05f;      // in a few of these it says what it sees

}  // namespace

void HeightVote::say(bool stands, float rise_m, float dt_s) {
    if (known_ && stands != stands_) {
        jump_m_ = rise_m_ - rise_m;
        since_s_ = 0.0f;
    } else {
        since_s_ += dt_s;
    }
    const float weight = stands ? 1.0f : kFreeWeight;
    weight_ += (weight - weight_) * (known_ ? 1.0f - std::exp(-dt_s / kWeightS) : 1.0f);
    known_ = true;
    stands_ = stands;
    target_m_ = rise_m;
    rise_m_ = rise_m + jump_m_ * left_of_glide(since_s_, kJumpS);
}

void HeightVote::stand(const Vec3& hip, const Vec3& target, float length_m, float dt_s) {
    const Vec3 way = target - hip;
    say(true, way.y + std::sqrt(std::max(length_m * length_m - way.x * way.x - way.z * way.z, 0.0f)), dt_s);
}

}  // namespace vfit
