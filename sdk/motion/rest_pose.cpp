#include "motion/rest_pose.h"

#include <cmath>

namespace vfit {

const LimbParts kLimbParts[kLimbCount] = {
    {VFIT_JOINT_LEFT_SHOULDER,
     VFIT_JOINT_LEFT_ELBOW,
     VFIT_JOINT_LEFT_WRIST,
     VFIT_JOINT_LEFT_HAND,
     VFIT_BONE_LEFT_SHOULDER,
     VFIT_BONE_LEFT_UPPER_ARM,
     VFIT_BONE_LEFT_LOWER_ARM,
     VFIT_BONE_LEFT_HAND,
     {0, -1, 0},
     1.0f,
     false},
    {VFIT_JOINT_RIGHT_SHOULDER,
     VFIT_JOINT_RIGHT_ELBOW,
     VFIT_JOINT_RIGHT_WRIST,
     VFIT_JOINT_RIGHT_HAND,
     VFIT_BONE_RIGHT_SHOULDER,
     VFIT_BONE_RIGHT_UPPER_ARM,
     VFIT_BONE_RIGHT_LOWER_ARM,
     VFIT_BONE_RIGHT_HAND,
     {0, 1, 0},
     -1.0f,
     false},
    {VFIT_JOINT_LEFT_HIP,
     VFIT_JOINT_LEFT_KNEE,
     VFIT_JOINT_LEFT_FOOT,
     VFIT_JOINT_LEFT_TOES,
     VFIT_BONE_HIPS,
     VFIT_BONE_LEFT_UPPER_LEG,
     VFIT_BONE_LEFT_LOWER_LEG,
     VFIT_BONE_LEFT_FOOT,
     {1, 0, 0},
     1.0f,
     true},
    {VFIT_JOINT_RIGHT_HIP,
     VFIT_JOINT_RIGHT_KNEE,
     VFIT_JOINT_RIGHT_FOOT,
     VFIT_JOINT_RIGHT_TOES,
     VFIT_BONE_HIPS,
     VFIT_BONE_RIGHT_UPPER_LEG,
     VFIT_BONE_RIGHT_LOWER_LEG,
     VFIT_BONE_RIGHT_FOOT,
     {1, 0, 0},
     -1.0f,
     true},
};

namespace {

constexpr float kLeastLengthM = 1e-6f;

Vec3 direction(const Vec3& v, const Vec3& otherwise) {
    const float length = glm::length(v);
    return length > kLeastLengthM ? v / length : otherwise;
}

Mat3 frame_of(const Vec3& primary, const Vec3& secondary) {
    const Vec3 x = glm::normalize(primary);
    Vec3 y = secondary - glm::dot(secondary, x) * x;
    const float length = glm::length(y);
    if (length > 1e-5f * glm::length(secondary))
        y /= length;
    else
        y = glm::normalize(glm::cross(x, std::abs(x.x) < 0.7f ? Vec3(1, 0, 0) : Vec3(0, 0, 1)));
    return Mat3(x, y, glm::cross(x, y));
}

}  // namespace

Quat align_pairs(const Vec3& primary_from, const Vec3& secondary_from, const Vec3& primary_to,
                 const Vec3& secondary_to) {
    const Mat3 rotation =
        frame_of(primary_to, secondary_to) * glm::transpose(frame_of(primary_from, secondary_from));
    return glm::normalize(glm::quat_cast(rotation));
}

RestPose::RestPose(const Skeleton& skeleton) {
    const PosedSkeleton rest = forward_kinematics(skeleton, Pose());
    const auto at = [&rest](int bone) { return rest.position[static_cast<size_t>(bone)]; };

    for (int i = 0; i < kLimbCount; ++i) {
        const LimbParts& parts = kLimbParts[i];
        RestLimb& limb = limbs[static_cast<size_t>(i)];
        const Vec3 fallback = parts.leg ? Vec3(0, -1, 0) : Vec3(parts.side, 0, 0);
        const Vec3 upper = at(parts.lower) - at(parts.upper), lower = at(parts.last) - at(parts.lower);
        limb.upper_m = glm::length(upper);
        limb.lower_m = glm::length(lower);
        limb.upper = direction(upper, fallback);
        limb.lower = direction(lower, fallback);
        limb.hinge = direction(parts.hinge - glm::dot(parts.hinge, limb.upper) * limb.upper, parts.hinge);
        limb.bend_rad = std::atan2(glm::dot(limb.lower, glm::cross(limb.hinge, limb.upper)),
                                   glm::dot(limb.lower, limb.upper));
    }
    toes[0] = direction(at(VFIT_BONE_LEFT_TOES) - at(VFIT_BONE_LEFT_FOOT), {0, 0, 1});
    toes[1] = direction(at(VFIT_BONE_RIGHT_TOES) - at(VFIT_BONE_RIGHT_FOOT), {0, 0, 1});

    const Vec3 middle = 0.5f * (at(VFIT_BONE_LEFT_UPPER_LEG) + at(VFIT_BONE_RIGHT_UPPER_LEG));
    hip_middle = middle - at(VFIT_BONE_HIPS);
    neck = at(VFIT_BONE_NECK) - middle;
    if (glm::length(neck) < kLeastLengthM) neck = Vec3(0, 1, 0);
    hip_left = direction(at(VFIT_BONE_LEFT_UPPER_LEG) - at(VFIT_BONE_RIGHT_UPPER_LEG), {1, 0, 0});
    chest_left = direction(at(VFIT_BONE_LEFT_UPPER_ARM) - at(VFIT_BONE_RIGHT_UPPER_ARM), {1, 0, 0});
    head = direction(at(VFIT_BONE_HEAD) - at(VFIT_BONE_NECK), {0, 1, 0});
}

}  // namespace vfit
