// Which feet stand on the floor (paper, Algorithm 5), by height and speed thresholds with hysteresis that
// adapt to the sensor and to where the floor seems to be. Either foot, both, or neither (a jump); and a foot is
// free when it is higher or faster, where the paper's line 10 waits for both and so holds a foot that slides.
#pragma once

#include <array>
#include <cstdint>

#include "math/types.h"

namespace vfit {

class FootContact {
public:
    void reset();

    /// Ankles of one new body in world space, left and right, and whether each is known.
    void update(const Vec3 ankles[2], const bool known[2], int64_t time_ns);

    bool planted(int side) const { return feet_[static_cast<size_t>(side)].planted; }
    /// A foot was planted by the last update (the paper's constraintSwitched).
    bool switched() const { return switched_; }

    /// Height of a standing ankle as the sensor reports it: the lowest seen lately. `otherwise` before any.
    float ankle_level(float otherwise) const;

private:
    struct Foot {
        bool known = false, planted = false;
        Vec3 position{0.0f}, velocity{0.0f};
        float level = 0;         // the lowest height lately
        float low_time_s = 0;    // low and slow for so long
        float planted_speed = 0; // m/s, mean while planted: the sensor's noise
    };
    void update_foot(Foot& foot, const Vec3& ankle, float dt_s);

    std::array<Foot, 2> feet_;
    int64_t time_ns_ = 0;
    bool started_ = false, switched_ = false;
};

}  // namespace vfit
