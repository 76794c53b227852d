#include "motion/rotation_smoothing.h"

#include <cmath>

#include "math/quaternion.h"

namespace vfit {

namespace {

constexpr float kPaperRateHz = 30.0f;  // the rate at which the paper's k is applied once a frame

}  // namespace

float smoothing_share(float divisor, float dt_s) {
    return 1.0f - std::pow(1.0f - 1.0f / divisor, dt_s * kPaperRateHz);
}

void RotationSmoother::apply(std::array<Quat, kBoneCount>& world, float divisor, float dt_s) {
    if (started_) {
        const float share = smoothing_share(divisor, dt_s);
        for (size_t i = 0; i < world.size(); ++i) {
            const Quat difference = world[i] * glm::conjugate(last_[i]);        // Eq. 8
            world[i] = glm::normalize(fraction(difference, share) * last_[i]);  // Eq. 9 and 10
        }
    }
    last_ = world;
    started_ = true;
}

}  // namespace vfit
