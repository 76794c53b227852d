// Known bodies for the tests of this room: a skeleton, random valid poses, the joints that a sensor would
// report for them.
#pragma once

#include <cmath>
#include <random>

#include "motion/motion.h"
#include "motion/rest_pose.h"

namespace vfit::testing {

inline constexpr float kDeg = kPi / 180.0f;
inline constexpr uint32_t kAllOff =
    VFIT_MOTION_NO_FILTER | VFIT_MOTION_NO_LIMITS | VFIT_MOTION_NO_SMOOTHING | VFIT_MOTION_NO_FEET;

inline int64_t frame_ns(int frame, double rate_hz = 30.0) {
    return static_cast<int64_t>(std::llround(1e9 * frame / rate_hz));
}

/// A T-pose that is no ideal cross: limbs slope and bend a little, as those of real characters.
inline Skeleton test_skeleton() {
    Skeleton s;
    auto& o = s.offset;
    o[VFIT_BONE_HIPS] = {0, 0.96f, 0};
    o[VFIT_BONE_SPINE] = {0, 0.08f, 0};
    o[VFIT_BONE_CHEST] = {0, 0.12f, 0};
    o[VFIT_BONE_UPPER_CHEST] = {0, 0.13f, 0};
    o[VFIT_BONE_NECK] = {0, 0.16f, 0};
    o[VFIT_BONE_HEAD] = {0, 0.09f, 0.02f};
    for (int side = 0; side < 2; ++side) {
        const float x = side == 0 ? 1.0f : -1.0f;
        const size_t arm = side == 0 ? VFIT_BONE_LEFT_SHOULDER : VFIT_BONE_RIGHT_SHOULDER;
        const size_t leg = side == 0 ? VFIT_BONE_LEFT_UPPER_LEG : VFIT_BONE_RIGHT_UPPER_LEG;
        o[arm] = {x * 0.03f, 0.12f, 0.0f};
        o[arm + 1] = {x * 0.15f, -0.01f, 0.0f};
        o[arm + 2] = {x * 0.28f, -0.01f, 0.004f};
        o[arm + 3] = {x * 0.25f, 0.0f, 0.01f};
        o[leg] = {x * 0.09f, -0.06f, 0.0f};
        o[leg + 1] = {x * 0.01f, -0.42f, 0.0f};
        o[leg + 2] = {0.0f, -0.40f, -0.01f};
        o[leg + 3] = {x * 0.01f, -0.05f, 0.13f};
    }
    s.ankle_height = 0.08f;
    return s;
}

inline Body joints_of(const Skeleton& skeleton, const Pose& pose, int64_t time_ns) {
    const PosedSkeleton p = forward_kinematics(skeleton, pose);
    const RestPose rest(skeleton);
    Body body;
    body.id = 1;
    body.time_ns = time_ns;
    body.set(VFIT_JOINT_NECK, p.position[VFIT_BONE_NECK]);
    body.set(VFIT_JOINT_HEAD, p.position[VFIT_BONE_HEAD]);
    body.set(VFIT_JOINT_PELVIS, p.position[VFIT_BONE_HIPS]);
    body.set(VFIT_JOINT_TORSO, p.position[VFIT_BONE_CHEST]);
    for (int i = 0; i < kLimbCount; ++i) {
        const LimbParts& parts = kLimbParts[i];
        const auto last = static_cast<size_t>(parts.last);
        body.set(parts.root, p.position[static_cast<size_t>(parts.upper)]);
        body.set(parts.middle, p.position[static_cast<size_t>(parts.lower)]);
        body.set(parts.end, p.position[last]);
        body.set(parts.tip, parts.leg
                                ? p.position[last + 1]
                                : p.position[last] + p.rotation[last] * rest.limbs[size_t(i)].lower * 0.08f);
    }
    return body;
}

/// Moves the hips so that the lower ankle stands on the floor.
inline void stand_on_floor(const Skeleton& skeleton, Pose& pose) {
    const PosedSkeleton p = forward_kinematics(skeleton, pose);
    const float lowest = std::min(p.position[VFIT_BONE_LEFT_FOOT].y, p.position[VFIT_BONE_RIGHT_FOOT].y);
    pose.hips_position.y += skeleton.ankle_height - lowest;
}

class RandomPose {
public:
    explicit RandomPose(uint32_t seed) : engine_(seed) {}
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    float degrees(float low, float high) { return kDeg * uniform(low, high); }

    /// Inside the natural ranges; the spine straight but twisted, which is what hips, neck and shoulders
    /// tell.
    Pose next(const Skeleton& skeleton) {
        const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
        const RestPose rest(skeleton);
        Pose pose;
        auto& r = pose.rotation;
        r[VFIT_BONE_HIPS] = glm::angleAxis(degrees(-180, 180), y) * glm::angleAxis(degrees(-25, 25), x) *
                            glm::angleAxis(degrees(-15, 15), z);
        const Quat twist = glm::angleAxis(degrees(-10, 10), y);
        r[VFIT_BONE_SPINE] = r[VFIT_BONE_CHEST] = r[VFIT_BONE_UPPER_CHEST] = twist;
        r[VFIT_BONE_NECK] = glm::angleAxis(degrees(-25, 25), x) * glm::angleAxis(degrees(-20, 20), z);
        for (int i = 0; i < kLimbCount; ++i) {
            const LimbParts& parts = kLimbParts[i];
            const RestLimb& limb = rest.limbs[static_cast<size_t>(i)];
            const float s = parts.side;
            Quat& upper = r[static_cast<size_t>(parts.upper)];
            Quat& lower = r[static_cast<size_t>(parts.lower)];
            Quat& last = r[static_cast<size_t>(parts.last)];
            if (parts.leg) {
                upper = glm::angleAxis(-degrees(-20, 90), x) * glm::angleAxis(s * degrees(-15, 25), z) *
                        glm::angleAxis(degrees(-10, 10), limb.upper);
                lower = glm::angleAxis(degrees(8, 120), limb.hinge);
                last = glm::angleAxis(degrees(-15, 40), x) * glm::angleAxis(degrees(-20, 20), y);
            } else {
                upper = glm::angleAxis(-s * degrees(-50, 80), y) * glm::angleAxis(s * degrees(-80, 60), z);
                upper = upper * glm::angleAxis(degrees(-30, 30), limb.upper);
                lower = glm::angleAxis(degrees(8, 130), limb.hinge);
                last = glm::angleAxis(s * degrees(-40, 40), z) * glm::angleAxis(degrees(-15, 15), y);
            }
        }
        pose.hips_position = {uniform(-1, 1), 1.0f, uniform(-3, -1)};
        stand_on_floor(skeleton, pose);
        return pose;
    }

private:
    std::mt19937 engine_;
};

inline float largest_joint_error(const Skeleton& skeleton, const Pose& a, const Pose& b) {
    const Body ja = joints_of(skeleton, a, 0), jb = joints_of(skeleton, b, 0);
    float worst = 0;
    for (int i = 0; i < kJointCount; ++i)
        if (ja.has(i) && i != VFIT_JOINT_TORSO) worst = std::max(worst, glm::length(ja.at(i) - jb.at(i)));
    return worst;
}

}  // namespace vfit::testing
