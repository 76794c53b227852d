#include "motion/rotation_smoothing.h"

#include <algorithm>
#include <cmath>

#include "math/quaternion.h"

namespace vfit {

namespace {

constexpr float kPaperRateHz = 30.0f;  // the rate at which the paper's k is applied once a frame

/// How fast a bone may turn in world space, rad/s. Relative to their parents, at 30 Hz in nine of the 16
/// recordings (swipes, claps, squats, walking), 99.5 % of the steps are slower than 4 (trunk, neck), 15
/// (upper arms), 14 (forearms) and 31 (hands). Above are joints that the tracker puts elsewhere from one
/// frame to the next; a bone comes there at this speed.
float max_turn_rad_s(int bone) {
    switch (bone) {
        case VFIT_BONE_LEFT_UPPER_ARM:
        case VFIT_BONE_RIGHT_UPPER_ARM: return 16.0f;
        case VFIT_BONE_LEFT_LOWER_ARM:
        case VFIT_BONE_RIGHT_LOWER_ARM: return 20.0f;
        case VFIT_BONE_LEFT_HAND:
        case VFIT_BONE_RIGHT_HAND: return 30.0f;
        case VFIT_BONE_LEFT_UPPER_LEG:
        case VFIT_BONE_RIGHT_UPPER_LEG:
        case VFIT_BONE_LEFT_LOWER_LEG:
        case VFIT_BONE_RIGHT_LOWER_LEG:
        case VFIT_BONE_LEFT_FOOT:
        case VFIT_BONE_RIGHT_FOOT:
        case VFIT_BONE_LEFT_TOES:
        case VFIT_BONE_RIGHT_TOES: return INFINITY;  // foot_planter.h and leg_return.h bound them
        default: return 8.0f;                        // trunk, neck, head, shoulders
    }
}

}  // namespace

float smoothing_share(float divisor, float dt_s) {
    return 1.0f - std::pow(1.0f - 1.0f / divisor, dt_s * kPaperRateHz);
}

void RotationSmoother::apply(std::array<Quat, kBoneCount>& world, float divisor, float dt_s) {
    if (started_) {
        const float share = smoothing_share(divisor, dt_s);
        for (size_t i = 0; i < world.size(); ++i) {
            const Quat difference = world[i] * glm::conjugate(last_[i]);  // Eq. 8
            const float turn = share * glm::length(rotation_vector(difference));
            const float bounded = std::min(turn, max_turn_rad_s(int(i)) * dt_s);
            const float part = turn > 0.0f ? share * bounded / turn : share;
            world[i] = glm::normalize(fraction(difference, part) * last_[i]);  // Eq. 9 and 10
        }
    }
    last_ = world;
    started_ = true;
}

}  // namespace vfit
