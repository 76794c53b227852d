// The trunk of a person who turned round on the spot, as its closed surface shows it.
#pragma once

#include <vector>

#include "scan/view_fusion.h"

namespace vfit {

/// Levels as those of TrunkProfile: shares of the way from between the hip joints (0) to the neck's joint
/// (1).
class TurnedTrunk {
public:
    static constexpr int kLevels = TrunkView::kLevels;

    /// 0.15 s for 72 views.
    explicit TurnedTrunk(const std::vector<TrunkView>& views);
    /// Overwrites the body's form.
    ~TurnedTrunk();
    TurnedTrunk(const TurnedTrunk&) = default;
    TurnedTrunk& operator=(const TurnedTrunk&) = default;

    /// Of a section's convex hull, which a taut tape follows; without arms. NaN where too little is seen, and
    /// outside the levels.
    float girth_m(float share) const;
    /// The largest or the smallest of the levels between two shares.
    float largest_girth_m(float low, float high) const;
    float smallest_girth_m(float low, float high) const;
    /// Between two shares, where the front stands out before the straight line from one to the other; NaN
    /// where nothing stands out or is seen.
    float bust(float low, float high) const;

private:
    TrunkSections sections_;
    std::array<float, size_t(kLevels)> girths_m_;
};

}  // namespace vfit
