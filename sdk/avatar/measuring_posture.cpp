// The avatar as a tailor wants it: upright, arms hanging clear of the trunk, feet at a stated distance.
#include <algorithm>
#include <cmath>

#include "avatar/avatar.h"
#include "core/error.h"

namespace vfit {

namespace {

const Vec3 kForward(0, 0, 1);

}  // namespace

float Avatar::touching_feet_m() const {
    // Feet stand in the measuring posture as they do at rest, so their inner sides can be read off there.
    const float left = anchors_[VFIT_JOINT_LEFT_FOOT].rest.x, right = anchors_[VFIT_JOINT_RIGHT_FOOT].rest.x;
    float left_inner = 0.0f, right_inner = 0.0f;
    for (size_t v = 0; v < topology_->vertex_count; ++v) {
        if (topology_->parts[v] == BodyPart::kLeftFoot)
            left_inner = std::max(left_inner, left - rest_.positions[v].x);
        else if (topology_->parts[v] == BodyPart::kRightFoot)
            right_inner = std::max(right_inner, rest_.positions[v].x - right);
    }
    return left_inner + right_inner;
}

Pose Avatar::measuring_pose(const MeasuringPosture& posture) const {
    if (!(posture.arm_angle_rad >= 0.0f && posture.arm_angle_rad <= 0.5f * kPi))
        fail(VFIT_ERROR_ARGUMENT, "the arm angle ", posture.arm_angle_rad,
             " is not between 0 and a right angle");
    if (!(posture.feet_apart_m >= 0.0f && posture.feet_apart_m <= 1.0f))
        fail(VFIT_ERROR_ARGUMENT, "feet ", posture.feet_apart_m, " m apart: not between 0 and 1 m");

    const auto& offset = skeleton().offset;
    const float half = 0.5f * std::max(posture.feet_apart_m, touching_feet_m());
    Pose pose;
    pose.hips_position = offset[VFIT_BONE_HIPS];
    const auto side = [&](float sign, int upper_arm, int upper_leg, int lower_leg, int foot) {
        const auto leg = static_cast<size_t>(upper_leg), ankle = static_cast<size_t>(foot);
        const float lowered = 0.5f * kPi - posture.arm_angle_rad;
        pose.rotation[static_cast<size_t>(upper_arm)] = glm::angleAxis(-sign * lowered, kForward);
        const float length = -offset[static_cast<size_t>(lower_leg)].y - offset[ankle].y;
        const float aside = half - sign * (offset[leg].x + pose.hips_position.x);
        const float tilt = std::asin(std::clamp(aside / length, -1.0f, 1.0f));
        pose.rotation[leg] = glm::angleAxis(sign * tilt, kForward);
        pose.rotation[ankle] = glm::angleAxis(-sign * tilt, kForward);
    };
    side(1.0f, VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG,
         VFIT_BONE_LEFT_FOOT);
    side(-1.0f, VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG,
         VFIT_BONE_RIGHT_FOOT);
    return pose;
}

Mesh Avatar::measuring_mesh(const MeasuringPosture& posture, Body* joints) const {
    PosedSkeleton posed;
    std::vector<Mat4> matrices(matrices_.size());
    rig_.pose(measuring_pose(posture), posed, matrices);

    Mesh mesh;
    mesh.positions.resize(skin_.vertex_count());
    mesh.indices = topology_->indices;
    SkinTarget target;
    target.positions = mesh.positions.data();
    Skin::Scratch scratch;
    skin_.pose(matrices, SkinMethod::linear, Axes(), target, scratch, *Jobs::own(0));
    mesh.positions.resize(topology_->vertex_count);

    float sole = mesh.positions.front().y;
    for (const Vec3& p : mesh.positions) sole = std::min(sole, p.y);
    for (Vec3& p : mesh.positions) p.y -= sole;
    if (joints) {
        *joints = joints_of(posed, matrices);
        for (Joint& joint : joints->joints) joint.position.y -= sole;
    }
    return mesh;
}

}  // namespace vfit
