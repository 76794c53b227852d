// Joints that tremble less and do not jump: one Euro filter each (Casiez, Roussel, Vogel 2012), with less
// trust in places that the network is unsure of.
#pragma once

#include <cstdint>

#include "track/skeleton.h"

namespace vfit {

inline constexpr float kMeasuredConfidence = 0.5f, kInferredConfidence = 0.15f;  // the least of each state

inline vfit_joint_state joint_state_of(float confidence) {
    return confidence >= kMeasuredConfidence   ? VFIT_JOINT_MEASURED
           : confidence >= kInferredConfidence ? VFIT_JOINT_INFERRED
                                               : VFIT_JOINT_NOT_SEEN;
}

class JointSteady {
public:
    /// In place, always in the same space. A joint of confidence 0 is not there. Where a joint's time does
    /// not grow, or it was away for over half a second, it starts afresh.
    void run(int64_t time_ns, SeenJoints& joints);

private:
    struct Channel {
        Vec3 place{0.0f}, speed{0.0f};
        int64_t seen_ns = 0;
        bool known = false;
    };
    std::array<Channel, kJointCount> channels_{};
};

}  // namespace vfit
