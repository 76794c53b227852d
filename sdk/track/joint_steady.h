// Joints that tremble less and do not jump: one Euro filter each (Casiez, Roussel, Vogel 2012), with less trust in
// places that the network is unsure of.
#pragma once

#include <cstdint>

#include "track/skeleton.h"

namespace vfit {

class JointSteady {
public:
    /// Camera space, in place. Times must grow; a gap of over half a second starts afresh.
    void run(int64_t time_ns, SeenJoints& joints);

private:
    struct Channel {
        Vec3 place{0.0f}, speed{0.0f};
    };
    int64_t last_ns_ = -1;
    std::array<Channel, kJointCount> channels_{};
};

}  // namespace vfit
