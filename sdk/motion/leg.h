// One leg of a posed skeleton, in the world: hip, knee and ankle, and the inverse kinematics that puts its
// ankle in a place.
#pragma once

#include "body/skeleton.h"
#include "math/two_bone_ik.h"
#include "motion/rest_pose.h"

namespace vfit {

struct Leg {
    const LimbParts* parts = nullptr;
    const RestLimb* rest = nullptr;
    Vec3 hip{0.0f}, ankle{0.0f};
    Quat upper{1, 0, 0, 0}, lower{1, 0, 0, 0}, foot{1, 0, 0, 0};

    Leg() = default;
    /// `side`: 0 left, 1 right.
    Leg(int side, const RestPose& pose, const PosedSkeleton& posed);

    float length() const { return glm::distance(hip, ankle); }

    /// Where the knee and the ankle get with the hip at `root` and the ankle sent to `goal`, the knee turned
    /// as it is now. Over the last `softness` of its length the leg eases into full extension against a knee
    /// that snaps.
    TwoBoneSolution solve(const Vec3& root, const Vec3& goal, float softness) const;
    /// Does it. The foot stays as it is in the world.
    void reach(const Vec3& root, const Vec3& goal, float softness);
    /// The whole leg goes along.
    void move_hip(const Vec3& by) {
        hip += by;
        ankle += by;
    }
    /// Turns the bones and leaves the hip where it is.
    void turn_to(const Quat& new_upper, const Quat& new_lower);

    /// Writes the leg's bones, under hips of that world rotation.
    void put(const Quat& hips, Pose& pose) const;

private:
    Vec3 knee_axis() const { return upper * rest->hinge; }
};

}  // namespace vfit
