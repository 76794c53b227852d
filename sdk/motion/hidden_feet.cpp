#include "motion/hidden_feet.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"

namespace vfit {

namespace {

// A foot that stood, is seen so far from its place and so near the other foot, has not stepped there: one
// that lifts is known to be free after a few centimetres.
constexpr float kTwinM = 0.36f, kAwayM = 0.08f;
constexpr float kLongestS = 0.4f;  // after that it may have gone anywhere
constexpr float kPlaceS = 0.1f;    // low-pass of the place
constexpr float kSure = 0.1f;      // confidence of an ankle that was put back
constexpr int kAnkles[2] = {VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_RIGHT_FOOT};
constexpr int kToes[2] = {VFIT_JOINT_LEFT_TOES, VFIT_JOINT_RIGHT_TOES};

}  // namespace

Body HiddenFeet::put_back(const Body& body, const bool planted[2]) {
    const float dt_s =
        std::clamp(static_cast<float>(seconds_between(time_ns_, body.time_ns)), 0.0f, kLongestS);
    time_ns_ = body.time_ns;
    Body out = body;
    for (size_t side = 0; side < 2; ++side) {
        Foot& foot = feet_[side];
        const int ankle = kAnkles[side], other = kAnkles[1 - side];
        if (!planted[side]) {
            foot = Foot();
            continue;
        }
        if (!body.has(ankle)) continue;
        const Vec3 seen = body.at(ankle);
        if (!foot.stands) {
            foot.stands = true;
            foot.place = seen;
            continue;
        }
        const float away = glm::distance(seen, foot.place);
        const bool twin = away > kAwayM && body.has(other) && glm::distance(seen, body.at(other)) < kTwinM;
        if (!twin || foot.hidden_s + dt_s > kLongestS) {
            if (!twin) foot.hidden_s = 0.0f;
            if (away < kAwayM) foot.place += (seen - foot.place) * (1.0f - std::exp(-dt_s / kPlaceS));
            continue;
        }
        foot.hidden_s += dt_s;
        out.set(ankle, foot.place, VFIT_JOINT_INFERRED, kSure);
        out.joints[static_cast<size_t>(ankle)].has_rotation = false;
        if (body.has(kToes[side]))
            out.set(kToes[side], body.at(kToes[side]) + foot.place - seen, VFIT_JOINT_INFERRED, kSure);
    }
    return out;
}

}  // namespace vfit
