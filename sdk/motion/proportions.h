// Segment lengths of the tracked person as running means, and the skeleton that they make: what feet are
// planted with when no avatar is bound, and what the root is scaled by when one is.
#pragma once

#include <array>

#include "body/skeleton.h"
#include "frame/body.h"

namespace vfit {

class Proportions {
public:
    Proportions();
    void reset();

    /// Takes the joints that were measured (not inferred), filtered.
    void update(const Body& body);

    const Skeleton& skeleton() const { return skeleton_; }

private:
    enum Segment {
        kTrunk,
        kHipHalf,
        kShoulderHalf,
        kShoulderDrop,
        kNeck,
        kUpperArm,
        kForearm,
        kThigh,
        kShank,
        kFoot,
        kSegmentCount
    };
    struct Mean {
        float value_m = 0;
        int count = 0;
    };
    void add(Segment segment, float length_m);
    void add_between(const Body& body, Segment segment, int from, int to, float share);
    void build();

    std::array<Mean, kSegmentCount> lengths_;
    Skeleton skeleton_;
};

}  // namespace vfit
