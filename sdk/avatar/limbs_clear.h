// Limbs that stay out of each other: a tracker's pose, or the pose of another person, puts arms into the
// trunk or through each other. Each arm is a chain shoulder, elbow, wrist with capsules around it;
// position-based dynamics (Mueller et al. 2007) moves elbow and wrist until the capsules are clear of trunk,
// thighs and the other arm, with room for cloth. The shoulder, the lengths and the hand's rotation in the
// world stay.
//
// From one pose to the next, arms go along a path: an arm that is before another, or before the trunk, comes
// behind it around the end of the hand, or around the trunk, and never through. Cloth could not follow.
#pragma once

#include <array>
#include <vector>

#include "avatar/rig.h"
#include "body/body_model.h"

namespace vfit {

struct LimbSegment {
    Vec3 from, to;
    Vec3 at(float share) const { return glm::mix(from, to, share); }
};

class LimbsClear {
    /// From the right arm's upper arm, or its forearm and hand, to those of the left: unit vectors; 0: they
    /// are not close.
    using Sides = std::array<std::array<Vec3, 2>, 2>;

public:
    /// Learns how thick trunk, thighs, arms and hands are from the rest mesh.
    LimbsClear(const AvatarRig& rig, std::span<const Vec3> rest, std::span<const BodyPart> parts);

    /// Where the arms were in the last pose.
    class Memory {
        friend class LimbsClear;
        struct Arm {
            Vec3 elbow, wrist, hand;  // in the chest's frame: from the shoulder, and from the wrist
        };
        struct State {
            int64_t time_ns = 0;
            bool is_known = false;
            Arm arms[2];
            Sides sides{};        // in the chest's frame
            float held_s = 0.0f;  // since the arms were last near to where the pose had them
        };
        State before_, now_;  // of two times
    };
    /// Turns arms where needed; an arm that is clear stays where it is, to the bit. `matrices` are those of
    /// the pose. Poses whose times do not follow each other closely have no path; a pose of the same time
    /// again has the path of the first one. Does not allocate.
    void run(const PosedSkeleton& posed, std::span<const Mat4> matrices, Memory& memory, Pose& pose) const;

private:
    static constexpr int kLevels = 16, kAngles = 16;
    /// How far the skin reaches from an axis of the rest mesh, by height along it and by angle about it.
    struct Outline {
        Vec3 start{0.0f}, axis{0.0f}, x{0.0f}, z{0.0f};  // unit vectors
        float least = 0.0f, length = 0.0f;               // of heights along the axis
        std::array<float, kLevels * kAngles> radius{};
        std::vector<int> bones;      // rig bones that carry it, from the start on
        std::vector<float> heights;  // where each of them starts

        void learn(std::span<const Vec3> points);
        float at(float height, float angle) const;
    };
    struct Exit {
        Vec3 direction{0.0f};  // world, unit length
        float depth_m = 0.0f;
    };
    /// A ball of the arm: its centre is (1 - elbow - wrist) shoulder + elbow E + wrist W + offset.
    struct Ball {
        float elbow, wrist;
        Vec3 offset;  // from the wrist, in the hand's rest
        float radius_m;
    };
    struct Arm {
        int hand_bone = 0;
        Vec3 hand{0.0f};  // rest: from the wrist to the knuckles
        struct Taper {
            float from_m, to_m;  // radii
        };
        Taper tapers[2]{};                    // of upper arm and forearm
        Vec3 across{1.0f, 0.0f, 0.0f};        // of the hand, rest: a unit vector towards the thumb's side
        float wide_m = 0.0f, thick_m = 0.0f;  // of the hand, from its line
        std::vector<Ball> balls;
    };
    /// An arm while it is moved.
    struct Chain {
        Vec3 shoulder, elbow, wrist, hand;  // hand: from the wrist to the knuckles
        Mat3 turn;                          // of the hand, from its rest
        float upper_m, lower_m;
        Vec3 at(const Ball& ball) const {
            return (1.0f - ball.elbow - ball.wrist) * shoulder + ball.elbow * elbow + ball.wrist * wrist +
                   turn * ball.offset;
        }
        LimbSegment segment_of(int part) const;
        void move(float on_elbow, float on_wrist, const Vec3& by);
        void push(int part, float share, const Vec3& by);
        void keep_lengths();
        float way_to(const Chain& other) const;
        void go_to(const Chain& other, float share);
    };
    void learn_arm(const AvatarRig& rig, std::span<const Vec3> rest, std::span<const BodyPart> parts,
                   size_t number);
    Exit exit_of(const Outline& outline, std::span<const Mat4> matrices, const Vec3& p, float radius,
                 float side) const;
    /// One pass; true where something was moved.
    bool clear_of_body(size_t arm, std::span<const Mat4> matrices, Chain& chain) const;
    bool clear_of_each_other(const Vec3& forward, Sides& sides, Chain (&chains)[2]) const;
    struct Meeting {
        int left, right;  // parts of the arms: upper arm, forearm, hand
        float on_left, on_right;
        Vec3 way;       // from the right one to the left one
        float apart_m;  // that they are to be
        bool at_free_end;
    };
    Meeting meeting_of(int left, int right, const Vec3& otherwise, const Chain (&chains)[2]) const;
    void clear(std::span<const Mat4> matrices, const Vec3& forward, int rounds, Sides& sides,
               Chain (&chains)[2]) const;
    float radius_m(size_t arm, const Chain& chain, int part, float share, const Vec3& direction) const;

    std::vector<Outline> outlines_;  // trunk, thighs
    std::array<Arm, 2> arms_;
};

}  // namespace vfit
