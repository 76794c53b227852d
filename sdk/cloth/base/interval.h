// A part of a step.
#pragma once

namespace vfit {

/// From one fraction of the step to another. Contacts are found at the begin of each interval.
struct Interval {
    float from = 0.0f, to = 1.0f;

    /// Fraction of the step at a fraction of the interval.
    float at(float fraction) const { return from + (to - from) * fraction; }
};

}  // namespace vfit
