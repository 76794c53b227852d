// World rotations of the humanoid bones from joint positions, relative to the T-pose. Where a joint carries
// a rotation of its own, that one is taken.
#pragma once

#include <array>

#include "frame/body.h"
#include "motion/rest_pose.h"
#include "motion/trunk.h"

namespace vfit {

using BoneRotations = std::array<Quat, kBoneCount>;

class BoneSolver {
public:
    void reset();

    /// Learns what direction from ankle to toes this source reports for a foot that stands on the floor.
    /// To be called once a body.
    void learn_flat_feet(const Body& body, const bool planted[2]);

    /// `planted`: the foot stands on the floor, left and right. dt_s: since the last call.
    void solve(const Skeleton& skeleton, const RestPose& rest, const Body& body, const Trunk& trunk,
               const bool planted[2], float dt_s, BoneRotations& world);

private:
    /// Roll of a limb about its upper bone: the angle from its natural hinge axis to the one that it has. Its
    /// plane tells it, the worse the straighter the limb; a Kalman filter weighs the two.
    struct Roll {
        bool known = false;
        float angle = 0.0f, variance = 0.0f;  // rad, rad^2

        void observe(float seen, float elbow_off_line_m, float dt_s);
    };
    void solve_spine(const Skeleton& skeleton, const RestPose& rest, const Body& body, const Trunk& trunk,
                     BoneRotations& world) const;
    void solve_limb(int index, const RestPose& rest, const Body& body, float dt_s, BoneRotations& world);
    void solve_foot(int side, const RestPose& rest, const Body& body, bool planted, BoneRotations& world);
    Vec3 hinge_of(int index, const RestLimb& rest, const Quat& parent, const Vec3& upper, const Vec3& lower,
                  float upper_m, float lower_m, float dt_s);

    std::array<Roll, kLimbCount> rolls_;
    struct FlatFoot {
        int count = 0;
        float elevation_rad = 0;  // of ankle to toes as this source reports it for a foot on the floor
    };
    std::array<FlatFoot, 2> flat_feet_;
};

}  // namespace vfit
