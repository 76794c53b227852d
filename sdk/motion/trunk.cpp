#include "motion/trunk.h"

namespace vfit {

namespace {

// Acromion to trochanter height over biacromial breadth: ANSUR II shares of stature, (0.820 - 0.513) / 0.237.
constexpr float kTrunkPerShoulderBreadth = 1.3f;
// Shorter lines between two joints have no direction that could be trusted, metres.
constexpr float kLeastLineM = 0.02f;

bool line(const Body& body, int left, int right, Vec3& direction) {
    if (!body.has(left) || !body.has(right)) return false;
    const Vec3 d = body.at(left) - body.at(right);
    const float length = glm::length(d);
    if (length < kLeastLineM) return false;
    direction = d / length;
    return true;
}

}  // namespace

bool find_trunk(const Body& body, Trunk& out) {
    const bool hips = line(body, VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP, out.hip_left);
    const bool shoulders = line(body, VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_RIGHT_SHOULDER, out.chest_left);
    const Vec3 shoulder_middle =
        0.5f * (body.at(VFIT_JOINT_LEFT_SHOULDER) + body.at(VFIT_JOINT_RIGHT_SHOULDER));

    if (body.has(VFIT_JOINT_NECK)) {
        out.neck = body.at(VFIT_JOINT_NECK);
    } else if (shoulders) {
        out.neck = shoulder_middle;
    } else {
        return false;
    }

    out.hips_seen = hips;
    if (hips) {
        out.hip_middle = 0.5f * (body.at(VFIT_JOINT_LEFT_HIP) + body.at(VFIT_JOINT_RIGHT_HIP));
    } else if (body.has(VFIT_JOINT_PELVIS)) {
        out.hip_middle = body.at(VFIT_JOINT_PELVIS);
    } else if (body.has(VFIT_JOINT_TORSO)) {
        out.hip_middle = 2.0f * body.at(VFIT_JOINT_TORSO) - out.neck;  // TORSO is the middle of the trunk
    } else if (shoulders) {
        const float breadth =
            glm::length(body.at(VFIT_JOINT_LEFT_SHOULDER) - body.at(VFIT_JOINT_RIGHT_SHOULDER));
        out.hip_middle = out.neck - Vec3(0, kTrunkPerShoulderBreadth * breadth, 0);
    } else {
        return false;
    }
    if (glm::length(out.neck - out.hip_middle) < kLeastLineM) return false;

    if (!hips && !shoulders) out.hip_left = Vec3(1, 0, 0);  // nothing tells the facing: towards the camera
    if (!hips && shoulders) out.hip_left = out.chest_left;
    if (!shoulders) out.chest_left = out.hip_left;
    return true;
}

}  // namespace vfit
