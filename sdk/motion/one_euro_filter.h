// One Euro filter on one joint position (Casiez, Roussel, Vogel 2012): a low-pass whose cutoff rises with
// speed.
#pragma once

#include "math/types.h"

namespace vfit {

struct OneEuroSettings {
    float min_cutoff_hz = 1.0f;         // at rest
    float beta = 1.0f;                  // Hz for each m/s
    float derivative_cutoff_hz = 1.0f;  // of the speed that the cutoff follows
};

class OneEuroFilter {
public:
    void reset() { known_ = false; }
    bool empty() const { return !known_; }

    /// Takes one reading, `dt_s` > 0 after the one before, and returns the output.
    Vec3 update(const OneEuroSettings& settings, const Vec3& reading, float dt_s);

    const Vec3& velocity() const { return velocity_; }  // m/s

private:
    bool known_ = false;
    Vec3 position_{0.0f}, velocity_{0.0f};
};

}  // namespace vfit
