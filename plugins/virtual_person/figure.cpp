#include "figure.h"

#include <algorithm>
#include <cmath>

namespace vfit::virtual_person {

namespace {

constexpr float kMostExtension = 0.999f;  // of the leg's length: a knee that is locked has no direction
// The lower of two reach limits, rounded over this range where they cross, so that the hips move without a
// kink.
constexpr float kLimitBlend_m = 0.012f;
// Beyond 60 degrees of elevation the shoulder blade takes about a third (scapulo-humeral rhythm, Inman 1944:
// one degree in three).
constexpr float kScapulaStart_deg = 60.0f, kScapulaShare = 1.0f / 3.0f;

constexpr float kHeel = 0.4f;  // behind the ankle, of the ball's distance before it
// Of the hip joints above the seat of one who sits (trochanterion height, sitting: 0.08 to 0.1 m).
constexpr float kHipOverSeat_m = 0.09f;

float smooth_min(float a, float b, float range) {
    const float h = std::max(range - std::abs(a - b), 0.0f) / range;
    return std::min(a, b) - h * h * range * 0.25f;
}

// Axes: along the limb, the hinge, and their cross product.
Mat3 limb_frame(const Vec3& along, const Vec3& hinge) {
    const Vec3 x = glm::normalize(along);
    const Vec3 y = glm::normalize(hinge - x * glm::dot(hinge, x));
    return Mat3(x, y, glm::cross(x, y));
}

Quat turn_frame(const Mat3& from, const Mat3& to) {
    return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
}

struct LegBones {
    int thigh, shank, foot, toes;
};
constexpr LegBones kLegBones[2] = {
    {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_FOOT, VFIT_BONE_LEFT_TOES},
    {VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_FOOT, VFIT_BONE_RIGHT_TOES}};

/// How far the ankle moves where the foot turns over its ball, or over its heel.
Vec3 rolled(const FootState& foot, float ankle_height_m, float ball_m) {
    const float ahead_m = foot.heel_rad > 0.0f ? ball_m : -kHeel * ball_m;
    const Quat yaw = glm::angleAxis(foot.yaw_rad, Vec3(0, 1, 0));
    const Vec3 point(0.0f, -ankle_height_m, ahead_m);
    return yaw * (point - glm::angleAxis(foot.heel_rad, Vec3(1, 0, 0)) * point);
}

}  // namespace

float standing_reach_m(const Leg& leg) {
    const float full = glm::length(leg.thigh) + glm::length(leg.shank);
    return std::min(glm::length(leg.thigh + leg.shank), kMostExtension * full);
}

LegPose reach_ankle(const Leg& leg, const Vec3& hip, const Vec3& ankle, const Vec3& knee_forward) {
    const float a = glm::length(leg.thigh), b = glm::length(leg.shank);
    const Vec3 to_ankle = ankle - hip;
    const float reach = glm::length(to_ankle);
    const float d = std::clamp(reach, std::abs(a - b) + 1e-4f, (a + b) * 0.99999f);
    const Vec3 down = reach > 1e-6f ? to_ankle / reach : Vec3(0, -1, 0);
    const Vec3 hinge = glm::normalize(glm::cross(knee_forward, down));
    const Vec3 forward = glm::cross(down, hinge);
    const float along = (a * a + d * d - b * b) / (2.0f * d);  // law of cosines
    const float off = std::sqrt(std::max(0.0f, a * a - along * along));
    const Vec3 thigh = down * along + forward * off;
    const Vec3 shank = down * d - thigh;
    const Vec3 rest_hinge(1, 0, 0);
    return {turn_frame(limb_frame(leg.thigh, rest_hinge), limb_frame(thigh, hinge)),
            turn_frame(limb_frame(leg.shank, rest_hinge), limb_frame(shank, hinge))};
}

void set_leg(std::array<Quat, VFIT_BONE_COUNT>& rotation, int side, const Quat& pelvis, const LegPose& leg,
             const Quat& foot_world, const Quat& toes_world) {
    const LegBones& bones = kLegBones[side];
    rotation[size_t(bones.thigh)] = glm::normalize(glm::conjugate(pelvis) * leg.thigh);
    rotation[size_t(bones.shank)] = glm::normalize(glm::conjugate(leg.thigh) * leg.shank);
    rotation[size_t(bones.foot)] = glm::normalize(glm::conjugate(leg.shank) * foot_world);
    rotation[size_t(bones.toes)] = glm::normalize(glm::conjugate(foot_world) * toes_world);
}

BonePose solve(const Proportions& proportions, const Figure& figure) {
    BonePose pose;
    pose.rotation = figure.rotation;
    const Quat heading = glm::angleAxis(figure.heading_rad, Vec3(0, 1, 0));
    const Quat pelvis = glm::normalize(heading * figure.pelvis);
    pose.rotation[VFIT_BONE_HIPS] = pelvis;
    pose.hips = Vec3(figure.root.x, 0, figure.root.y);

    std::array<Vec3, 2> hip, ankle;
    std::array<float, 2> limit;  // of the hips' height, by the reach of each leg
    for (const int side : {kLeft, kRight}) {
        const auto i = static_cast<size_t>(side);
        const FootState& foot = figure.foot[i];
        const Leg& leg = proportions.leg[i];
        // Over a raised heel the ball of the foot stays on the floor; with raised toes the heel does, which
        // lies below the ankle.
        const float ball = glm::length(Vec2(leg.foot.x, leg.foot.z));
        const float rise = foot.heel_rad > 0.0f
                               ? ball * std::sin(foot.heel_rad) -
                                     (1.0f - std::cos(foot.heel_rad)) * proportions.ankle_height_m
                               : 0.0f;
        ankle[i] = Vec3(foot.place.x, proportions.ankle_height_m + foot.lift_m + rise, foot.place.y);
        if (foot.over_a_point) ankle[i] += rolled(foot, proportions.ankle_height_m, ball) - Vec3(0, rise, 0);
        hip[i] = pose.hips + pelvis * leg.hip;
        const float reach = standing_reach_m(leg);
        const float aside = glm::length(Vec2(ankle[i].x - hip[i].x, ankle[i].z - hip[i].z));
        limit[i] = ankle[i].y + std::sqrt(std::max(0.0f, reach * reach - aside * aside)) - hip[i].y;
    }
    pose.hips.y = smooth_min(limit[0], limit[1], kLimitBlend_m) - figure.drop_m;
    if (figure.seated > 0.0f) {
        const float sitting = figure.seat_m + kHipOverSeat_m - 0.5f * (hip[0].y + hip[1].y);
        pose.hips.y += figure.seated * (sitting - pose.hips.y);
    }

    for (const int side : {kLeft, kRight}) {
        const auto i = static_cast<size_t>(side);
        const FootState& foot = figure.foot[i];
        const Quat yaw = glm::angleAxis(foot.yaw_rad, Vec3(0, 1, 0));
        const Quat foot_world = yaw * glm::angleAxis(foot.heel_rad, Vec3(1, 0, 0));
        // The knee points halfway between pelvis and toes.
        const Vec3 forward = glm::normalize(yaw * Vec3(0, 0, 1) + heading * Vec3(0, 0, 1));
        hip[i].y += pose.hips.y;
        const LegPose leg = reach_ankle(proportions.leg[i], hip[i], ankle[i], forward);
        set_leg(pose.rotation, side, pelvis, leg, foot_world, foot.heel_rad > 0.0f ? yaw : foot_world);
        pose.contact[i] = foot.planted, pose.rolls[i] = foot.rolls;
    }
    return pose;
}

void set_arm(std::array<Quat, VFIT_BONE_COUNT>& rotation, int side, const ArmAngles& arm) {
    const float s = side_sign(side);
    const int clavicle = side == kLeft ? VFIT_BONE_LEFT_SHOULDER : VFIT_BONE_RIGHT_SHOULDER;
    const int upper = side == kLeft ? VFIT_BONE_LEFT_UPPER_ARM : VFIT_BONE_RIGHT_UPPER_ARM;
    const int lower = side == kLeft ? VFIT_BONE_LEFT_LOWER_ARM : VFIT_BONE_RIGHT_LOWER_ARM;
    const float raised = std::max(0.0f, arm.abduct - kScapulaStart_deg);
    const Quat blade = rotate_z(s * kScapulaShare * raised);
    const Quat whole = rotate_x(-arm.flex) * rotate_z(-s * (90.0f - arm.abduct)) * rotate_x(-arm.turn);
    rotation[size_t(clavicle)] = blade;
    rotation[size_t(upper)] = glm::normalize(glm::conjugate(blade) * whole);
    rotation[size_t(lower)] = rotate_y(-s * arm.elbow);
}

}  // namespace vfit::virtual_person
