// A bone that follows its tracked rotation with a bounded angular acceleration: exactly, while that is one of
// people, and catching up smoothly where it jumps.
#pragma once

#include "math/types.h"

namespace vfit {

class BoundedTurn {
public:
    /// The rotation to show `dt_s` after the last one; the first is `tracked` itself. `most`: rad/s^2.
    Quat follow(const Quat& tracked, float most, float dt_s);

    /// Something else turned the bone to this.
    void set(const Quat& shown, float dt_s);

private:
    bool known_ = false;
    Quat shown_{1, 0, 0, 0}, tracked_{1, 0, 0, 0};
    Vec3 velocity_{0.0f};  // rad/s about the world's axes
};

}  // namespace vfit
