#include "motion/holt_filter.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kLeastJitterRadiusM = 1e-4f;  // of the Kinect SDK; keeps the division below finite

/// The share of a step that is done when a per-frame share is applied `frames` times over.
float share_after(float share, float frames) { return 1.0f - std::pow(1.0f - share, frames); }

}  // namespace

Vec3 HoltFilter::update(const HoltSettings& s, const Vec3& reading, bool inferred, float frames) {
    const float radius_scale = inferred ? 2.0f : 1.0f;
    const float jitter = std::max(kLeastJitterRadiusM, s.jitter_radius_m) * radius_scale;
    const float max_deviation = s.max_deviation_radius_m * radius_scale;
    const float correction = share_after(s.correction, frames);

    Vec3 level = reading;
    Vec3 trend{0.0f};
    if (count_ == 1) {
        level = 0.5f * (reading + reading_);
        trend = correction / frames * (level - level_) + (1.0f - correction) * trend_;
    } else if (count_ >= 2) {
        const float distance = glm::length(reading - level_);
        const float share = distance <= jitter ? share_after(distance / jitter, frames) : 1.0f;
        level = level_ + share * (reading - level_);
        const float history = std::pow(s.smoothing, frames);
        level = (1.0f - history) * level + history * (level_ + frames * trend_);
        trend = correction / frames * (level - level_) + (1.0f - correction) * trend_;
    }
    count_ = std::min(count_ + 1, 2);
    reading_ = reading;
    level_ = level;
    trend_ = trend;

    const Vec3 predicted = level + s.prediction * trend;
    const float deviation = glm::length(predicted - reading);
    if (deviation <= max_deviation) return predicted;
    return reading + (predicted - reading) * (max_deviation / deviation);
}

}  // namespace vfit
