// The trunk's outline by height, read off the image without a body's shape: how far it reaches to both sides of the fitted
// spine and towards the camera, at levels from the hips to the armpits.
#pragma once

#include <array>
#include <cstdint>

#include "fit/body_fit.h"
#include "frame/depth_image.h"
#include "scan/view_kind.h"

namespace vfit {

class TrunkProfile {
public:
    static constexpr int kLevels = 14;
    /// What is read at a level, metres from the fitted spine.
    enum Reach {
        kAhead,        // seen from the side: to the person's front; from the front: half the breadth
        kBehind,       // seen from the side: to the back
        kTowards,      // towards the camera: of the surface before the spine
        kTowardsHalf,  // and halfway to the outlines, mean of both
        kReaches
    };
    using Reaches = std::array<float, kReaches>;

    /// Of the frame that was fitted last.
    void add(const DepthImage& image, uint8_t user, const BodyFit& fit, ViewKind view);
    /// Means over frames; NaN where nothing was seen.
    Reaches reaches_m(ViewKind view, int level) const;
    /// Overwrites all that was seen.
    void reset();

private:
    struct Sum {
        double metres = 0.0;
        uint32_t count = 0;
    };
    std::array<std::array<std::array<Sum, kReaches>, kLevels>, kViewKinds> sums_{};
};

}  // namespace vfit
