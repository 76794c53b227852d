#include "motion/joint_feet.h"

#include "math/two_bone_ik.h"

namespace vfit {

void JointFeet::apply(const bool planted[2], const Vec3 knee_fronts[2], float ankle_level, float dt_s,
                      Body& body) {
    for (int side = 0; side < 2; ++side) {
        const int hip = VFIT_JOINT_LEFT_HIP + side, knee = VFIT_JOINT_LEFT_KNEE + side;
        const int ankle = VFIT_JOINT_LEFT_FOOT + side, toes = VFIT_JOINT_LEFT_TOES + side;
        if (!body.has(ankle)) continue;
        FootPin& pin = pins_[static_cast<size_t>(side)];
        const Vec3 tracked = body.at(ankle);
        const Vec3 shown = pin.update(tracked, planted[side], standing_height(tracked.y, ankle_level), dt_s);
        if (pin.offset() == Vec3(0.0f)) continue;
        body.joints[static_cast<size_t>(ankle)].position = shown;
        if (body.has(toes)) body.joints[static_cast<size_t>(toes)].position += pin.offset();
        if (!body.has(hip) || !body.has(knee)) continue;
        const float thigh_m = glm::length(body.at(knee) - body.at(hip));
        const float shank_m = glm::length(tracked - body.at(knee));
        if (thigh_m < 1e-3f || shank_m < 1e-3f) continue;
        body.joints[static_cast<size_t>(knee)].position =
            solve_two_bone(body.at(hip), thigh_m, shank_m, shown, knee_fronts[side], 0.0f).middle;
    }
}

}  // namespace vfit
