// Hands that stay outside: a pose of one person puts the hands of a wider character into its hips. Each hand
// that would enter trunk or thighs is led out by the shortest way about their axis, and its arm follows.
#pragma once

#include <array>
#include <vector>

#include "avatar/rig.h"
#include "body/body_model.h"

namespace vfit {

class HandsClear {
public:
    /// Learns how thick trunk, thighs and hands are from the rest mesh.
    HandsClear(const AvatarRig& rig, std::span<const Vec3> rest, std::span<const BodyPart> parts);

    /// Turns arms where needed; a hand that is clear stays where it is, to the bit. `matrices` are those of
    /// the pose. Does not allocate.
    void run(const PosedSkeleton& posed, std::span<const Mat4> matrices, Pose& pose) const;

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
    struct Way {
        Vec3 out{0.0f};  // world
        float depth = 0.0f;
    };
    Way way_out(const Outline& outline, std::span<const Mat4> matrices, const Vec3& p, float radius,
                float side) const;

    std::vector<Outline> outlines_;  // trunk, thighs
    struct Hand {
        int rig_bone = 0;
        std::array<Vec3, 4> points{};  // rest: from the wrist to the fingers
        float radius = 0.0f;           // half of the palm's thickness
    };
    std::array<Hand, 2> hands_;
};

}  // namespace vfit
