// Dressing: carried to another body, kept outside of it, sized, and moved by its bones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "cloth/garment/dress.h"
#include "cloth_support.h"
#include "post.h"

namespace vfit {
namespace {

using namespace test;

/// That garment of cotton, authored on one post and worn by another.
template <typename... Rest>
Dress dress_of(const Garment& garment, const Post& authored, const Post& wearer, Rest... rest) {
    return Dress(garment, BoundGarment(garment, authored.body()), cotton(), wearer.body(), rest...);
}

float radius_of(const Vec3& p) { return std::hypot(p.x, p.z); }

TEST(Dress, IsCarriedToAWiderBodyWithItsEase) {
    const Post thin(0.1f), wide(0.15f);
    const Garment g = sleeve(0.12f);
    validate_garment(g, library());
    const Dress same = dress_of(g, thin, thin), wider = dress_of(g, thin, wide);
    for (size_t i = 0; i < g.vertex_count(); ++i) {
        ASSERT_LT(glm::length(same.rest()[i] - g.mesh.positions[i]), 1e-5f);
        ASSERT_NEAR(radius_of(wider.rest()[i]), 0.17f, 1.5e-3f);
        ASSERT_NEAR(wider.rest()[i].y, g.mesh.positions[i].y, 1e-4f);
    }
    EXPECT_EQ(wider.held().size(), kRound);
    EXPECT_EQ(wider.fabric()->simulated_count(), 9 * kRound) << "what holds it is not pinned";
}

TEST(Dress, IsPushedOutOfTheBody) {
    const Post post(0.1f);
    const Dress dress = dress_of(sleeve(0.09f), post, post, 1.0f, 0.005f);
    const float flat = std::cos(kPi / float(kRound));  // the post's sides are flat
    for (const Vec3& p : dress.rest()) ASSERT_GT(radius_of(p), 0.1f * flat + 0.0045f);
}

TEST(Dress, SizeScalesRestLengthsAroundTheBodyOnly) {
    const Post post(0.1f);
    const Garment g = sleeve(0.12f);
    const auto lengths = [&](float ratio) {
        const Dress dress = dress_of(g, post, post, ratio);
        float level = 0.0f, upright = 0.0f;
        for (const DistanceConstraint& e : dress.fabric()->data().edges) {
            if (e.a / kRound == 4 && e.b / kRound == 4) level += e.rest_m;
            if (e.b == e.a + kRound) upright += e.rest_m;
        }
        return Vec2(level, upright);
    };
    const Vec2 own = lengths(1.0f), large = lengths(1.2f);
    ASSERT_GT(own.x, 0.5f);
    EXPECT_NEAR(large.x / own.x, 1.2f, 1e-3f);
    EXPECT_NEAR(large.y / own.y, 1.0f, 1e-5f);
}

TEST(Dress, AShapeOfItsOwnIsKeptByALabelAndGoesWithTheBodyWithoutOne) {
    const Post thin(0.1f), wide(0.15f);
    Garment g = sleeve(0.12f);
    for (const Vec3& p : g.mesh.positions) g.cut_shape.push_back(1.1f * p);  // modelled larger than it hangs
    g.sizes.push_back({"M", {}, {}});
    validate_garment(g, library());
    const auto around = [&](const Dress& dress) {
        float sum = 0.0f;
        for (const DistanceConstraint& e : dress.fabric()->data().edges)
            if (e.a / kRound == 4 && e.b / kRound == 4) sum += e.rest_m;
        return sum;
    };
    const float side = 2.0f * float(kRound) * std::sin(kPi / float(kRound));  // of a ring of radius 1
    EXPECT_NEAR(around(dress_of(g, thin, thin, 1.0f, 0.004f, &g.sizes[0])), 1.1f * 0.12f * side, 1e-4f);
    EXPECT_NEAR(around(dress_of(g, thin, wide, 1.0f, 0.004f, &g.sizes[0])), 1.1f * 0.12f * side, 1e-4f);
    EXPECT_NEAR(around(dress_of(g, thin, thin)), 1.1f * 0.12f * side, 1e-4f);
    EXPECT_NEAR(around(dress_of(g, thin, wide)), 1.1f * 0.17f * side, 0.02f);
    // Only its own uvs say where the warp runs: down, as those of the sleeve do, whatever they are scaled by.
    const auto softest = [&](const Garment& of) {
        const Dress dress = dress_of(of, thin, thin, 1.0f, 0.004f, &of.sizes[0]);
        std::vector<float> out;
        for (const DistanceConstraint& e : dress.fabric()->data().edges) out.push_back(e.compliance_m_n);
        return out;
    };
    Garment stretched = g;
    for (Vec2& uv : stretched.mesh.uvs) uv *= 40.0f;
    const std::vector<float> a = softest(g), b = softest(stretched);
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-3f * a[i]);
}

TEST(Dress, FollowsItsBones) {
    const Post post(0.1f);
    const Dress dress = dress_of(sleeve(0.12f), post, post);
    const std::vector<Mat4> moved{Mat4(1.0f), glm::translate(Mat4(1.0f), Vec3(0.3f, 0, 0))};
    std::vector<Vec3> targets;
    Dress::Scratch scratch;
    dress.place(moved, targets, scratch, *Jobs::own(0));
    ASSERT_EQ(targets.size(), dress.fabric()->target_count());
    EXPECT_LT(glm::length(targets[0] - (dress.rest()[0] + Vec3(0.3f, 0, 0))), 1e-5f);
    const auto end = targets.begin() + std::ptrdiff_t(dress.rest().size());
    // A hanging row between both bones is led by both: no tear.
    for (size_t i = kRound; i < dress.rest().size(); ++i)
        ASSERT_LT(glm::length(targets[i] - targets[i - kRound]), 0.25f) << i;
    // Backstops lie on the post's axis, half a post's breadth below the skin.
    for (auto ball = end; ball != targets.end(); ++ball)
        ASSERT_LT(std::min(radius_of(*ball), radius_of(*ball - Vec3(0.3f, 0, 0))), 0.01f);
    EXPECT_EQ(error_of([&] { dress.place(std::span(moved).first(1), targets, scratch, *Jobs::own(0)); }),
              "-2 1 skinning matrices for a skin of 2 bones");
}

TEST(Dress, AStepFollowsWhatIsFixedOrLimitedAndTheBackstops) {
    const Post post(0.1f);
    Garment g = sleeve(0.12f);
    g.most_way.assign(g.vertex_count(), 0.0f);
    const uint32_t limited = g.vertex_count() - 1;
    g.most_way[limited] = 0.05f;
    const Dress dress = dress_of(g, post, post);
    const std::vector<Mat4> still(2, Mat4(1.0f)),
        moved{glm::translate(Mat4(1.0f), Vec3(0, 0, 0.1f)), glm::translate(Mat4(1.0f), Vec3(0.3f, 0, 0))};
    const auto jobs = Jobs::own(0);
    std::vector<Vec3> before, after, followed;
    Dress::Scratch scratch;
    dress.place(still, before, scratch, *jobs);
    dress.place(moved, after, scratch, *jobs);
    followed = before;
    dress.follow(moved, followed, scratch, *jobs);
    size_t hang = 0;
    for (uint32_t i = 0; i < followed.size(); ++i) {
        const bool hangs = i < g.vertex_count() && g.simulated[i] && i != limited;
        EXPECT_EQ(followed[i], hangs ? before[i] : after[i]) << i;
        hang += hangs;
    }
    EXPECT_GT(hang, size_t(kRound));
}

TEST(Dress, WhatIsFixedIsLiftedOverAGarmentBelow) {
    const Post post(0.1f);
    const Dress below = dress_of(sleeve(0.12f), post, post);
    Dress above = dress_of(sleeve(0.12f), post, post);
    above.lift_over(below, 0.006f);
    std::vector<Vec3> targets;
    Dress::Scratch scratch;
    above.place(std::vector<Mat4>(2, Mat4(1.0f)), targets, scratch, *Jobs::own(0));
    for (const uint32_t v : above.held()) {
        EXPECT_NEAR(radius_of(targets[v]), 0.126f, 1e-3f);
        EXPECT_EQ(above.rest()[v], below.rest()[v]) << "its cut stays";
    }
}

TEST(Dress, HangsOnThePostAndStaysOutsideIt) {
    const auto jobs = Jobs::own(0);
    const Post post(0.1f);
    const Dress dress = dress_of(sleeve(0.115f), post, post);
    std::vector<Vec3> targets;
    Dress::Scratch scratch;
    const std::vector<Mat4> still(2, Mat4(1.0f));
    dress.place(still, targets, scratch, *jobs);
    Cloth cloth(dress.fabric(), {}, targets);
    for (int frame = 0; frame < 120; ++frame) {
        const std::vector<Mat4> sway(
            2, glm::translate(Mat4(1.0f), Vec3(0.1f * std::sin(0.2f * float(frame)), 0, 0)));
        dress.follow(sway, targets, scratch, *jobs);
        cloth.step(kFrame_s, targets, {}, *jobs);
        const float x = 0.1f * std::sin(0.2f * float(frame));
        // Without any collider, the backstops alone keep the post free.
        for (const Vec3& p : cloth.positions())
            ASSERT_GT(radius_of(p - Vec3(x, 0, 0)), 0.1f) << "frame " << frame;
    }
    EXPECT_LT(cloth.stats().strain_mean, 0.02f);
}

TEST(Dress, RefusesABodyOfAnotherTopology) {
    const Post post(0.1f);
    DressBody body = post.body();
    body.positions = body.positions.first(10);
    const Garment g = sleeve(0.12f);
    EXPECT_EQ(error_of([&] { Dress(g, BoundGarment(g, post.body()), cotton(), body); }),
              "-2 garment sleeve: authored body and avatar differ in topology");
}

}  // namespace
}  // namespace vfit
