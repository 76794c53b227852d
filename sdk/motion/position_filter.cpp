#include "motion/position_filter.h"

#include <algorithm>

namespace vfit {

namespace {

// Inferred joints lie some three times farther off than measured ones; an unsure one as its confidence says.
constexpr float kInferredNoise = 3.0f, kLeastConfidence = 0.25f;

}  // namespace

Vec3 PositionFilter::update(const PositionFilterSettings& settings, const Vec3& reading, bool inferred,
                            float confidence, float dt_s) {
    switch (settings.kind) {
        case VFIT_POSITION_HOLT: {
            const float frames = holt_.empty() ? 1.0f : dt_s * kHoltRateHz;
            const Vec3 position = holt_.update(settings.holt, reading, inferred, frames);
            velocity_ = holt_.trend() * kHoltRateHz;
            return position;
        }
        case VFIT_POSITION_ONE_EURO: {
            const Vec3 position = one_euro_.update(settings.one_euro, reading, dt_s);
            velocity_ = one_euro_.velocity();
            return position;
        }
        default: {
            const float noise_scale =
                inferred ? kInferredNoise : 1.0f / std::clamp(confidence, kLeastConfidence, 1.0f);
            adaptive_.update(reading, noise_scale, dt_s);
            velocity_ = adaptive_.velocity();
            return adaptive_.position();
        }
    }
}

}  // namespace vfit
