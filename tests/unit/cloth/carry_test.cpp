// Carry: cloth goes with the bones between steps; rigidly where they do, as the skinned garment where it is
// skinned.
#include "cloth/garment/carry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "avatar/skin.h"
#include "support/allocation_count.h"  // counted by cloth_test.cpp

namespace vfit {

namespace {

using test::allocations;

/// A strip of vertices that goes over from one bone to another.
struct Strip {
    static constexpr size_t kCount = 3000;  // several items of work
    std::vector<Vec3> rest, positions, normals;
    std::vector<SkinBones> bones;
    std::vector<SkinWeights> weights;
    Strip() {
        for (size_t i = 0; i < kCount; ++i) {
            const float t = float(i) / float(kCount - 1);
            rest.emplace_back(0.1f * std::sin(40.0f * t), 1.0f - t, 0.1f * std::cos(40.0f * t));
            normals.push_back(glm::normalize(Vec3(rest.back().x, 0.02f, rest.back().z)));
            bones.push_back({0, 1});
            weights.push_back({1.0f - t, t});
        }
        positions = rest;
    }
};

TEST(Carry, FindsPlacesWithinTheBones) {
    const std::vector<SkinBones> bones{{0}, {1}, {0, 1}};
    const std::vector<SkinWeights> weights{{1.0f}, {1.0f}, {0.25f, 0.75f}};
    const std::vector<BoneAxis> axes{{{-0.1f, 0, 0}, {-0.1f, 1, 0}}, {{0.1f, 0, 0}, {0.1f, 1, 0}}};
    const std::vector<Vec3> on =
        Carry(bones, weights)
            .on_axes(axes, std::vector<Vec3>{{-0.4f, 0.5f, 0.2f}, {0.3f, 1.5f, 0.1f}, {0, 0.5f, 0.3f}});
    EXPECT_LT(glm::distance(on[0], Vec3(-0.1f, 0.5f, 0)), 1e-6f);
    EXPECT_LT(glm::distance(on[1], Vec3(0.1f, 1, 0)), 1e-6f) << "not beyond its end";
    EXPECT_LT(glm::distance(on[2], Vec3(0.05f, 0.5f, 0)), 1e-6f);
}

Mat4 turned(const Vec3& axis, float angle_rad, const Vec3& about) {
    return glm::translate(Mat4(1.0f), about) * glm::rotate(Mat4(1.0f), angle_rad, glm::normalize(axis)) *
           glm::translate(Mat4(1.0f), -about);
}

float furthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    float most = 0.0f;
    for (size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::length(a[i] - b[i]));
    return most;
}

std::vector<Vec3> moved(const Mat4& m, const std::vector<Vec3>& all, float w) {
    std::vector<Vec3> out;
    for (const Vec3& p : all) out.emplace_back(m * Vec4(p, w));
    return out;
}

const std::vector<Mat4> kBent = {turned({1, 0, 0}, 0.2f, {0, 1, 0}),
                                 turned({1, 0, 0.3f}, 1.1f, {0, 0.5f, 0})};

TEST(Carry, ARigidMotionOfAllBonesIsThatOfTheCloth) {
    const Strip strip;
    const Carry carry(strip.bones, strip.weights);
    const auto jobs = Jobs::own(1);
    const Mat4 motion =
        turned({0.3f, 1, -0.2f}, 2.0f, {0.5f, 0, 2}) * glm::translate(Mat4(1.0f), Vec3(1, -0.5f, 2));
    Carry::Unposed unposed;
    carry.take_out(kBent, strip.positions, strip.normals, unposed, *jobs);
    std::vector<Vec3> positions(Strip::kCount), normals(Strip::kCount);
    carry.put_in(kBent, unposed, positions, normals, *jobs);
    EXPECT_LT(furthest(positions, strip.positions), 2e-6f) << "no motion, no change";
    EXPECT_LT(furthest(normals, strip.normals), 5e-6f);
    std::vector<Mat4> now = kBent;
    for (Mat4& m : now) m = motion * m;
    carry.put_in(now, unposed, positions, normals, *jobs);
    EXPECT_LT(furthest(positions, moved(motion, strip.positions, 1.0f)), 5e-6f);
    EXPECT_LT(furthest(normals, moved(motion, strip.normals, 0.0f)), 5e-6f);
}

TEST(Carry, WhatIsSkinnedStaysOnTheSkin) {
    Strip strip;
    const Carry carry(strip.bones, strip.weights);
    const Skin skin(strip.bones, strip.weights, strip.rest, {});
    const auto jobs = Jobs::own(0);
    Skin::Scratch scratch;
    skin.carry(kBent, strip.positions, scratch, *jobs);
    Carry::Unposed unposed;
    carry.take_out(kBent, strip.positions, strip.normals, unposed, *jobs);
    std::vector<Mat4> now = kBent;
    now[1] = turned({0, 1, 0}, 0.4f, {0, 0.5f, 0}) * now[1];
    std::vector<Vec3> positions(Strip::kCount), normals(Strip::kCount), skinned;
    carry.put_in(now, unposed, positions, normals, *jobs);
    skin.carry(now, skinned, scratch, *jobs);
    EXPECT_LT(furthest(positions, skinned), 5e-6f);
    for (const Vec3& n : normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
}

TEST(Carry, BonesTurnedAgainstEachOtherThrowNothingAway) {
    const Strip strip;
    const Carry carry(strip.bones, strip.weights);
    const auto jobs = Jobs::own(0);
    // Half a turn: the blend in the middle is flat, and back again it must not be an inverse of that.
    const std::vector<Mat4> folded = {Mat4(1.0f), turned({0, 1, 0}, 3.14159f, {0, 0, 0})},
                            straight(2, Mat4(1.0f));
    Carry::Unposed unposed;
    carry.take_out(folded, strip.positions, strip.normals, unposed, *jobs);
    std::vector<Vec3> positions(Strip::kCount), normals(Strip::kCount);
    carry.put_in(straight, unposed, positions, normals, *jobs);
    for (const Vec3& p : positions) EXPECT_LT(glm::length(p - Vec3(0, 0.5f, 0)), 0.9f);
}

TEST(Carry, DoesNotAllocateAfterTheFirstCall) {
    const Strip strip;
    const Carry carry(strip.bones, strip.weights);
    const auto jobs = Jobs::own(1);
    Carry::Unposed unposed;
    std::vector<Vec3> positions(Strip::kCount), normals(Strip::kCount);
    carry.take_out(kBent, strip.positions, strip.normals, unposed, *jobs);
    const uint64_t before = allocations;
    for (int i = 0; i < 3; ++i) {
        carry.take_out(kBent, strip.positions, strip.normals, unposed, *jobs);
        carry.put_in(kBent, unposed, positions, normals, *jobs);
    }
    EXPECT_EQ(allocations - before, 0u);
}

}  // namespace

}  // namespace vfit
