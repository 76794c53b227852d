// What one frame of a turn shows of the trunk: its surface before the spine, level by level, and its outline
// to both sides.
#pragma once

#include <array>
#include <cstdint>

#include "fit/body_fit.h"
#include "frame/depth_image.h"
#include "scan/trunk_profile.h"

namespace vfit {

/// In the view's own axes, metres from the fitted spine at each level: across to the camera's right, and
/// towards the camera, both level.
struct TrunkView {
    static constexpr int kLevels = TrunkProfile::kLevels;  // the same ones
    static constexpr int kColumns = 60;
    static constexpr float kColumn_m = 0.015f;
    static constexpr float across_m(int column) {
        return (float(column) + 0.5f - 0.5f * float(kColumns)) * kColumn_m;
    }
    enum Side { kLeftOfPicture, kRightOfPicture, kSides };

    /// How far the person is turned to the camera's right from facing it, radians.
    float facing_rad = 0.0f;
    /// What the sensor loses of this outline, metres.
    float outline_loss_m = 0.0f;
    /// Towards the camera; NaN where nothing of the trunk is seen.
    std::array<std::array<float, kColumns>, kLevels> towards_m{};
    /// How far the line of sight along the outline passes from the spine; NaN where an arm or the image's
    /// border hides it, and where the spine itself has no reading.
    std::array<std::array<float, kSides>, kLevels> reach_m{};
    /// From the spine's line of sight to that of the outline, radians, where reach_m is seen.
    std::array<std::array<float, kSides>, kLevels> aside_rad{};
};

/// Of the frame that was fitted last, with a user map. Does not allocate.
void look_at_trunk(const DepthImage& image, uint8_t user, const BodyFit& fit, TrunkView& out);

}  // namespace vfit
