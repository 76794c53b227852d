// Which feet stand on the floor: either foot, both, or neither (a jump). By a network that has learnt it, or
// by the thresholds of height and speed of the paper's Algorithm 5, with hysteresis.
#pragma once

#include <array>
#include <cstdint>

#include "frame/body.h"
#include "motion/contact_features.h"
#include "motion/standing_level.h"
#include "vfit.h"

namespace vfit {

class FootContact {
public:
    void reset();

    /// Takes one new body in world space, unfiltered.
    void update(const Body& body, vfit_contact_rule rule);

    bool planted(int side) const { return feet_[static_cast<size_t>(side)].planted; }
    /// A foot was planted by the last update (the paper's constraintSwitched).
    bool switched() const { return switched_; }

    /// Height of a standing ankle as the sensor reports it. `otherwise` before any.
    float ankle_level(float otherwise) const { return standing_.value(otherwise); }

private:
    struct Foot {
        bool known = false, planted = false;
        Vec3 position{0.0f}, velocity{0.0f};
        float level = 0;          // the lowest height lately
        float low_time_s = 0;     // low and slow for so long
        float planted_speed = 0;  // m/s, mean while planted: the sensor's noise
        float unseen_s = 0;       // for so long
        float chance = 0;         // to stand, of the last body
    };
    void follow(Foot& foot, const Vec3& ankle, float dt_s);
    bool by_thresholds(Foot& foot, float dt_s) const;
    bool by_network(Foot& foot, int side) const;
    void keep_one_down(bool stands[2]) const;
    float lowest_level() const;
    void find_floor(const Body& body, float dt_s);

    std::array<Foot, 2> feet_;
    StandingLevel standing_;
    ContactFeatures features_;
    int64_t time_ns_ = 0;
    bool started_ = false, switched_ = false;
};

}  // namespace vfit
