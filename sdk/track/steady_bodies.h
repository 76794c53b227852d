// Joints of somebody else's middleware, treated like the tracker's own: state by confidence, and the same
// filter.
#pragma once

#include <cstdint>
#include <map>

#include "frame/body.h"
#include "track/joint_steady.h"

namespace vfit {

/// States that the confidence does not bear out are lowered: MEASURED from kMeasuredConfidence on, INFERRED
/// from kInferredConfidence on, else NOT_SEEN. Where a body comes without any confidence its states stand for
/// it.
void judge_states(Body& body);

class SteadyBodies {
public:
    /// Judges the states and filters the positions, in place, in one space for all bodies. Rotations stay as
    /// they are. Somebody who was away for over two seconds, or comes with an earlier time stamp, starts
    /// afresh.
    void run(Body& body);
    void reset() { people_.clear(); }

private:
    struct Person {
        JointSteady steady;
        int64_t seen_ns = 0;
    };
    std::map<uint32_t, Person> people_;  // by body id, of which there are 255
};

}  // namespace vfit
