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

    /// `planted`: the foot stands on the floor, left and right.
    void solve(const Skeleton& skeleton, const RestPose& rest, const Body& body, const Trunk& trunk,
               const bool planted[2], BoneRotations& world);

private:
    struct Limb {
        bool held = false;
        Vec3 upper{0.0f}, hinge{0.0f};  // in the parent's space, as last solved
    };
    void solve_spine(const Skeleton& skeleton, const RestPose& rest, const Body& body, const Trunk& trunk,
                     BoneRotations& world) const;
    void solve_limb(int index, const RestPose& rest, const Body& body, BoneRotations& world);
    void solve_foot(int side, const RestPose& rest, const Body& body, bool planted, BoneRotations& world);
    Vec3 hinge_of(int index, const RestLimb& rest, const Quat& parent, const Vec3& upper, const Vec3& lower,
                  float upper_m, float lower_m);

    std::array<Limb, kLimbCount> limbs_;
    struct FlatFoot {
        int count = 0;
        float elevation_rad = 0;  // of ankle to toes as this source reports it for a foot on the floor
    };
    std::array<FlatFoot, 2> flat_feet_;
};

}  // namespace vfit
