// How broad the trunk is by height and by the direction that it is seen from, read off its outline while the
// person turns round.
#pragma once

#include <array>
#include <cstdint>

#include "fit/body_fit.h"
#include "frame/depth_image.h"
#include "scan/trunk_profile.h"

namespace vfit {

class TurnBreadths {
public:
    static constexpr int kLevels = TrunkProfile::kLevels;  // the same ones
    /// Of half a turn: the outline from behind is that from the front.
    static constexpr int kDirections = 18;

    /// Of the frame that was fitted last. Does not allocate.
    void add(const DepthImage& image, uint8_t user, const BodyFit& fit);
    /// Without arms; NaN where they hide the outline.
    float breadth_m(int level, int direction) const;
    /// Of the level's convex hull, which a taut tape follows: pi times its mean breadth over half a turn
    /// (Cauchy 1841). NaN where too few directions are seen.
    float girth_m(int level) const;
    /// Overwrites all that was seen.
    void reset();

private:
    struct Sum {
        double metres = 0.0;
        uint32_t count = 0;
    };
    std::array<std::array<Sum, kDirections>, kLevels> sums_{};
};

}  // namespace vfit
