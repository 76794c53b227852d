// How much of a person's outline a sensor loses: pixels there see the person and what is behind at once, and
// come without a reading or with one in between.
#pragma once

#include <cstdint>

#include "frame/depth_image.h"

namespace vfit {

/// The outline runs through the middle of what is unsure between the last reading of the person and the first
/// of the background. Half of that gap, averaged, is what the user map lacks all around, whatever the sensor.
class OutlineLoss {
public:
    /// Of the person's pixels in a frame. Does not allocate.
    void add(const DepthImage& image, uint8_t user);
    /// Mean over the outlines of all frames, in pixels; 0 where nothing was seen behind any of them.
    float pixels() const { return count_ ? float(double(gaps_) / double(count_) / 2.0) : 0.0f; }
    /// Whether a background was seen.
    bool seen() const { return count_ > 0; }
    void reset() { gaps_ = count_ = 0; }

private:
    uint64_t gaps_ = 0, count_ = 0;
};

}  // namespace vfit
