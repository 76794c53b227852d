// A person who walks, with ground truth of contact, and what a depth sensor makes of it: planted feet that
// slide, noise on all joints.
#pragma once

#include "math/two_bone_ik.h"
#include "motion_support.h"

namespace vfit::testing {

struct WalkFrame {
    Body body;
    bool planted[2];
};

class SyntheticWalk {
public:
    explicit SyntheticWalk(const Skeleton& skeleton) : skeleton_(skeleton), rest_(skeleton) {}

    float speed = 0.8f, step_s = 0.6f;  // m/s; one foot swings while the other stands
    float lift_m = 0.12f;
    float slide_m = 0.02f, slide_hz = 1.3f;  // of the planted feet, as sensors report them
    float noise_m = 0.002f;

    /// Of an ankle in the middle of its swing, m/s.
    float swing_speed() const { return 2.0f * speed / kSwings; }

    /// Both feet stand for the first 15 % of each step.
    WalkFrame at(int frame, double rate_hz = 30.0) {
        const float t = static_cast<float>(frame / rate_hz);
        Pose pose;
        pose.hips_position = {0, skeleton_.offset[VFIT_BONE_HIPS].y - 0.03f, speed * t - 3.0f};
        WalkFrame out;
        out.body = joints_of(skeleton_, pose, frame_ns(frame, rate_hz));
        for (int side = 0; side < 2; ++side) place_leg(t, side, out);
        for (Joint& joint : out.body.joints)
            if (joint.seen())
                joint.position += noise_m * Vec3(normal_(engine_), normal_(engine_), normal_(engine_));
        return out;
    }

private:
    static constexpr float kSwings = 0.425f;  // of a cycle of two steps

    void place_leg(float t, int side, WalkFrame& out) {
        const float cycle = t / (2 * step_s) + (side == 0 ? 0.0f : 0.5f);
        const float whole = std::floor(cycle), phase = cycle - whole;  // swings in 0.575..1
        const float length = 2 * step_s * speed;
        const float from = (whole - (side == 0 ? 0.0f : 0.5f)) * length - 3.0f + 0.28f * length;
        Vec3 ankle(side == 0 ? 0.1f : -0.1f, skeleton_.ankle_height, from);
        const float swing = (phase - (1.0f - kSwings)) / kSwings;
        out.planted[side] = swing <= 0;
        if (swing > 0) {
            ankle.z += length * (swing - std::sin(2 * kPi * swing) / (2 * kPi));
            ankle.y += lift_m * 0.5f * (1 - std::cos(2 * kPi * swing));
        } else {
            const float slide = slide_m * std::sin(2 * kPi * slide_hz * t + static_cast<float>(side));
            ankle += Vec3(slide, 0, 0.7f * slide);
        }
        const RestLimb& leg = rest_.limbs[size_t(kLeftLeg + side)];
        const Vec3 hip = out.body.at(VFIT_JOINT_LEFT_HIP + side);
        const TwoBoneSolution ik = solve_two_bone(hip, leg.upper_m, leg.lower_m, ankle, {0, 0, 1}, 0.0f);
        out.body.set(VFIT_JOINT_LEFT_KNEE + side, ik.middle);
        out.body.set(VFIT_JOINT_LEFT_FOOT + side, ik.end);
        out.body.set(VFIT_JOINT_LEFT_TOES + side, ik.end + Vec3(0, -0.05f, 0.13f));
    }

    Skeleton skeleton_;
    RestPose rest_;
    std::mt19937 engine_{21};
    std::normal_distribution<float> normal_{0.0f, 1.0f};
};

}  // namespace vfit::testing
