// Position filter of a whole body: one filter a joint, joints that vanish and return, and the state of all
// joints at any moment between two bodies.
#pragma once

#include <array>

#include "frame/body.h"
#include "motion/position_filter.h"

namespace vfit {

class BodyFilter {
public:
    void reset();

    /// Takes the joints of a body newer than the last. `settings` null: positions pass as they come.
    void update(const Body& body, const PositionFilterSettings* settings);

    /// Every joint seen so far, at a time not before the last body. A joint follows its trend for about
    /// kTrendTimeS and then holds; one that the last body lacked is VFIT_JOINT_INFERRED, and its confidence
    /// falls, to rise again as it glides to where it came back.
    void sample(int64_t time_ns, Body& out) const;

    static constexpr float kTrendTimeS = 0.1f;    // time constant after which a trend has died away
    static constexpr float kBridgeTimeS = 0.25f;  // a longer loss starts the joint's filter anew
    static constexpr float kForgetTimeS = 0.5f;   // time constant with which confidence in a lost joint falls
    static constexpr float kReturnTimeS = 0.15f;  // time constant of the glide to where a joint came back

private:
    struct Track {
        PositionFilter filter;
        Joint joint;  // as last seen, position filtered
        int64_t seen_ns = 0;
        bool seen = false, lost = false;
        Vec3 velocity{0.0f};       // m/s, the trend
        Vec3 return_offset{0.0f};  // from the filtered place to where the joint was shown when it came back
        float return_doubt = 0;    // of the confidence, likewise
        int64_t return_ns = 0;
    };
    static Vec3 shown(const Track& track, int64_t time_ns);
    static float confidence(const Track& track, int64_t time_ns);

    std::array<Track, kJointCount> tracks_;
    Body last_;  // id and flags
};

}  // namespace vfit
