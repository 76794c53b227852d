// The trunk's outline by height, read off the image without a body's shape: how far it reaches to both sides
// of the fitted spine and towards the camera, at levels from the hips to the armpits: the front of each
// section, and its sides.
#pragma once

#include <array>
#include <cstdint>

#include "fit/body_fit.h"
#include "frame/depth_image.h"
#include "scan/view_kind.h"

namespace vfit {

class TrunkProfile {
public:
    static constexpr int kLevels = 24;
    /// Where a level is on the way from between the hip joints (0) to the neck's joint (1).
    static constexpr float along(int level) {
        return kLowest + (kHighest - kLowest) * float(level) / float(kLevels - 1);
    }
    /// What is read at a level, metres from the fitted spine: across the picture to the outline, and towards
    /// the camera where the spine is and at parts of the way to the outline. Seen from the side `ahead` is to
    /// the person's front and `behind` to the back; from the front both sides are one, ahead.
    enum Reach {
        kTowards,
        kAhead,
        kAheadQuarter,
        kAheadHalf,
        kAheadThreeQuarters,
        kBehind,
        kBehindQuarter,
        kBehindHalf,
        kBehindThreeQuarters,
        kReaches
    };
    static constexpr size_t kReachesFromFront = size_t(kBehind);
    using Reaches = std::array<float, size_t(kReaches)>;

    /// Of the frame that was fitted last.
    void add(const DepthImage& image, uint8_t user, const BodyFit& fit, ViewKind view);
    /// Means over frames; NaN where nothing was seen.
    Reaches reaches_m(ViewKind view, int level) const;
    /// Overwrites all that was seen.
    void reset();

private:
    static constexpr float kLowest = -0.2f, kHighest = 0.82f;
    struct Sum {
        double metres = 0.0;
        uint32_t count = 0;
    };
    std::array<std::array<std::array<Sum, kReaches>, kLevels>, kViewKinds> sums_{};
};

}  // namespace vfit
