#include "paper/body_lines.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Trackers place hips, neck and pelvis by habits of their own (a Kinect v1's hips lie 40 mm above the hip
// joint's centre).
constexpr float kJointSigma_m = 0.03f;

/// What spread legs cost in height: the level distance between hip and ankle tilts the leg.
float spread_loss(const Camera& camera, const Body& body) {
    constexpr float kMost_m = 0.015f;  // reference bodies: 4 to 9 mm with the feet 0.25 to 0.35 m apart
    const Vec3& up = camera.floor_normal;
    const Vec3 right = glm::cross(Vec3(0, 0, 1), up);
    float sum = 0.0f;
    int legs = 0;
    for (const auto& [hip, foot] : {std::pair{VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_FOOT},
                                    std::pair{VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_FOOT}}) {
        if (!body.has(hip) || !body.has(foot)) continue;
        const Vec3 leg = body.at(hip) - body.at(foot);
        const float upright = glm::dot(leg, up), level = glm::dot(leg, right);
        sum += std::sqrt(upright * upright + level * level) - upright;
        ++legs;
    }
    return legs > 0 ? std::clamp(sum / float(legs), 0.0f, kMost_m) : 0.0f;
}

Estimate hip_height(const Camera& camera, const Body& body, const Upright& upright) {
    if (!upright.floor.known) return {};
    float sum = 0.0f;
    int hips = 0;
    for (const int hip : {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP}) {
        if (!body.has(hip)) continue;
        sum += glm::dot(camera.floor_normal, body.at(hip));
        ++hips;
    }
    if (hips == 0) return {};
    return {sum / float(hips) - upright.floor.value_m, std::hypot(kJointSigma_m, upright.floor.sigma_m),
            true};
}

Estimate torso_height(const Body& body) {
    if (!body.has(VFIT_JOINT_NECK)) return {};
    if (body.has(VFIT_JOINT_PELVIS))
        return {glm::length(body.at(VFIT_JOINT_NECK) - body.at(VFIT_JOINT_PELVIS)), kJointSigma_m, true};
    if (!body.has(VFIT_JOINT_LEFT_HIP) || !body.has(VFIT_JOINT_RIGHT_HIP)) return {};
    const Vec3 pelvis = 0.5f * (body.at(VFIT_JOINT_LEFT_HIP) + body.at(VFIT_JOINT_RIGHT_HIP));
    return {glm::length(body.at(VFIT_JOINT_NECK) - pelvis), kJointSigma_m, true};
}

}  // namespace

Lines measure_lines(const FilteredDepth& depth, const Camera& camera, const Body& body) {
    Lines lines{};
    if (depth.pixels == 0) return lines;
    const Upright upright = measure_upright(depth, camera, body);
    if (upright.crown.known && upright.floor.known) {
        const float height = upright.crown.value_m - upright.floor.value_m + spread_loss(camera, body);
        constexpr float kPostureSigma_m = 0.006f;  // how upright a person stands from day to day
        at(lines, Line::kBodyHeight) = {
            height, std::hypot(std::hypot(upright.crown.sigma_m, upright.floor.sigma_m), kPostureSigma_m),
            true};
    }
    at(lines, Line::kHeadWidth) = head_width(depth, camera, body, upright);
    at(lines, Line::kHeadHeight) = head_height(depth, camera, body, upright);
    at(lines, Line::kHipHeight) = hip_height(camera, body, upright);
    at(lines, Line::kElbowFingertip) = elbow_fingertip(depth, camera, body, false);
    at(lines, Line::kWristFingertip) = elbow_fingertip(depth, camera, body, true);
    at(lines, Line::kShoulderWidth) = shoulder_width(depth, camera, body);
    at(lines, Line::kHipWidth) = hip_width(depth, camera, body);
    at(lines, Line::kTorsoHeight) = torso_height(body);
    return lines;
}

}  // namespace vfit
