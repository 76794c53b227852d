// Holt's double exponential filter on one joint position, with the five parameters of the Kinect SDK
// (paper 3.3.1, refs. 39 and 40): exact at 30 Hz, converted by elapsed time at other rates.
#pragma once

#include "math/types.h"

namespace vfit {

inline constexpr float kHoltRateHz = 30.0f;  // the frame rate that the five parameters are tuned for

struct HoltSettings {
    float smoothing = 0.5f;   // 0..1, weight of the forecast against the reading
    float correction = 0.5f;  // 0..1, how fast the trend follows
    float prediction = 0.5f;  // frames of 1/30 s to look ahead
    float jitter_radius_m = 0.05f;
    float max_deviation_radius_m = 0.04f;  // of the output from the reading
};

class HoltFilter {
public:
    void reset() { count_ = 0; }
    bool empty() const { return count_ == 0; }

    /// Takes one reading, `frames` nominal frames (1/30 s) after the one before, and returns the output.
    /// An inferred joint has both radii doubled.
    Vec3 update(const HoltSettings& settings, const Vec3& reading, bool inferred, float frames);

    /// Metres per nominal frame.
    const Vec3& trend() const { return trend_; }

private:
    int count_ = 0;  // 0, 1, then 2 for "two or more"
    Vec3 reading_{0.0f}, level_{0.0f}, trend_{0.0f};
};

}  // namespace vfit
