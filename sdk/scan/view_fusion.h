// Views of a turn laid over each other until one closed surface explains all of them.
#pragma once

#include <array>
#include <vector>

#include "math/types.h"
#include "scan/trunk_view.h"

namespace vfit {

/// A level section about the spine: radii in equal steps of direction, from straight ahead on to the
/// person's left. NaN where no view shows it.
struct TrunkSection {
    static constexpr int kDirections = 48;
    static constexpr float kStep_rad = 2.0f * kPi / float(kDirections);
    std::array<float, size_t(kDirections)> radii_m{};

    /// Ahead (y) and to that side (x), metres.
    Vec2 point(size_t direction) const {
        const float turned = float(direction) * kStep_rad;
        return radii_m[direction] * Vec2(std::sin(turned), std::cos(turned));
    }
};
using TrunkSections = std::array<TrunkSection, size_t(TrunkView::kLevels)>;

/// 0.15 s for 72 views.
void fuse_views(const std::vector<TrunkView>& views, TrunkSections& sections);

}  // namespace vfit
