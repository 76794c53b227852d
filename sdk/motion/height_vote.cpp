#include "motion/height_vote.h"

#include <algorithm>
#include <cmath>

#include "motion/glide.h"

namespace vfit {

namespace {

constexpr float kWeightS = 0.35f;  // time constant with which a foot gains and loses its say
constexpr float kJumpS = 0.05f;    // in a few of these it says what it sees

}  // namespace

void HeightVote::gain(float weight, float dt_s) {
    weight_ += (weight - weight_) * (known_ ? 1.0f - std::exp(-dt_s / kWeightS) : 1.0f);
    known_ = true;
}

void HeightVote::stand(const Vec3& hip, const Vec3& target, float length_m, float dt_s) {
    const Vec3 way = target - hip;
    const float rise_m =
        way.y + std::sqrt(std::max(length_m * length_m - way.x * way.x - way.z * way.z, 0.0f));
    if (!stands_) {
        jump_m_ = known_ ? rise_m_ - rise_m : 0.0f;
        stood_s_ = 0.0f;
    } else {
        stood_s_ += dt_s;
    }
    stands_ = true;
    const float before_m = rise_m_;
    rise_m_ = rise_m + jump_m_ * left_of_glide(stood_s_, kJumpS);
    change_m_ = known_ ? rise_m_ - before_m : 0.0f;
    gain(1.0f, dt_s);
}

void HeightVote::swing(float change_m, float dt_s) {
    stands_ = false;
    rise_m_ += change_m;
    change_m_ = 0.0f;
    gain(0.0f, dt_s);
}

}  // namespace vfit
