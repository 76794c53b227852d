// Contact: fast colliders do not pass, vertices stay out, Coulomb's cone, backstops, depenetration.
#include <gtest/gtest.h>

#include <cmath>

#include "cloth/contact/contact.h"
#include "cloth_support.h"

namespace vfit {
namespace {

using namespace test;

ClothSettings bare() {
    ClothSettings s;
    s.damping = 0.0f;
    s.thickness_m = 0.0f;
    s.friction = 0.0f;
    return s;
}

float distance_to(const Collider& collider, const Vec3& p) {
    return nearest_ball(CapsuleShape(capsule_of(collider, 0.0f)), p).distance;
}

TEST(Contact, NearestBallIsThatOfADenseScan) {
    const Capsule c{{0.1f, 0.2f, -0.1f}, {0.4f, -0.3f, 0.2f}, 0.05f, 0.15f};
    const CapsuleShape shape(c);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p(std::sin(1.7f * float(i)), std::sin(2.3f * float(i) + 1.0f),
                     std::sin(3.1f * float(i) + 2.0f));
        float best = INFINITY;
        for (int k = 0; k <= 4000; ++k) {
            const float t = float(k) / 4000.0f;
            best =
                std::min(best, glm::length(p - glm::mix(c.a, c.b, t)) - glm::mix(c.radius_a, c.radius_b, t));
        }
        ASSERT_NEAR(nearest_ball(shape, p).distance, best, 1e-5f);
        ASSERT_EQ(may_touch({shape, shape, 0.0f, {}}, p, best + 1e-4f), true);
        if (best > 1e-4f) {
            ASSERT_EQ(may_touch({shape, shape, 0.0f, {}}, p, best - 1e-4f), false);
        }
    }
}

TEST(Contact, CapsuleWithOneBallInsideTheOtherIsTheBiggerBall) {
    const Capsule c = capsule_of(capsule({0, 0, 0}, 0.05f, {0.01f, 0, 0}, 0.2f), 0.01f);
    EXPECT_TRUE(c.is_ball());
    EXPECT_FLOAT_EQ(c.radius_a, 0.21f);
    EXPECT_EQ(c.a, Vec3(0.01f, 0, 0));
}

/// Has the collider, gone along +X to its end, left the vertex behind, in the way that it took?
bool went_through(const Vec3& p, const Vec3& end, float radius) {
    return p.x < end.x && std::hypot(p.y - end.y, p.z - end.z) < radius;
}

/// One vertex on the way of a collider that crosses 2 m in one frame (120 m/s): pushed ahead or aside.
TEST(Contact, FastSphereDoesNotPassAVertex) {
    const auto jobs = Jobs::own(0);
    for (const float offset : {0.0f, 0.02f, 0.045f}) {
        ClothSettings settings = bare();
        settings.gravity = Vec3(0.0f);
        settings.substeps = 1;
        const std::vector<Vec3> start{{0, offset, 0}};
        Cloth cloth(lone_vertex(), settings, start);
        cloth.step(kFrame_s, start, std::vector{sphere({-1, 0, 0}, 0.05f)}, *jobs);
        const Collider end = sphere({1, 0, 0}, 0.05f);
        cloth.step(kFrame_s, start, std::vector{end}, *jobs);
        EXPECT_FALSE(went_through(cloth.positions()[0], end.center, 0.05f)) << offset;
        if (offset == 0.0f) {
            EXPECT_GT(cloth.positions()[0].x, 1.0f);
        }
        EXPECT_GT(distance_to(end, cloth.positions()[0]), -1e-4f) << offset;
    }
}

TEST(Contact, FastCapsuleDoesNotPassAVertex) {
    const auto jobs = Jobs::own(0);
    for (const float along : {-0.3f, -0.1f, 0.0f, 0.2f, 0.3f}) {
        ClothSettings settings = bare();
        settings.gravity = Vec3(0.0f);
        settings.substeps = 1;
        const std::vector<Vec3> start{{0, along, 0.01f}};
        Cloth cloth(lone_vertex(), settings, start);
        cloth.step(kFrame_s, start, std::vector{capsule({-1, -0.3f, 0}, 0.04f, {-1, 0.3f, 0}, 0.08f)}, *jobs);
        const Collider end = capsule({1, -0.3f, 0}, 0.04f, {1, 0.3f, 0}, 0.08f);
        cloth.step(kFrame_s, start, std::vector{end}, *jobs);
        const Vec3 p = cloth.positions()[0];
        const float y = std::clamp(p.y, -0.3f, 0.3f);
        EXPECT_FALSE(went_through(p, Vec3(1, y, 0), 0.06f + 0.04f / 0.6f * y)) << along;
        EXPECT_GT(distance_to(end, cloth.positions()[0]), -1e-4f) << along;
    }
}

TEST(Contact, TurningCapsuleSweepsItsWayClear) {
    // A leg of 0.8 m swings by 0.8 rad a frame, 38 m/s at its end, at the usual sub-steps.
    const auto jobs = Jobs::own(0);
    ClothSettings settings = bare();
    settings.gravity = Vec3(0.0f);
    const std::vector<Vec3> start{{0, -0.5f, 0}};
    Cloth cloth(lone_vertex(), settings, start);
    const auto leg = [](float angle) {
        return capsule({0, 0, 0}, 0.09f, {0.8f * std::sin(angle), -0.8f * std::cos(angle), 0}, 0.05f);
    };
    cloth.step(kFrame_s, start, std::vector{leg(-0.4f)}, *jobs);
    cloth.step(kFrame_s, start, std::vector{leg(0.4f)}, *jobs);
    EXPECT_GT(cloth.positions()[0].x, 0.1f);
    EXPECT_GT(distance_to(leg(0.4f), cloth.positions()[0]), -1e-3f);
}

TEST(Contact, CapsuleThatTurnsRoundInOneStepLeavesTheClothWhole) {
    // Left and right taken for each other: at half way both ends are one point.
    const auto jobs = Jobs::own(0);
    Sheet sheet(20, 20, 0.02f);
    sheet.pin_top();
    for (Vec3& p : sheet.positions) p += Vec3(-0.19f, 0.19f, 0.13f);
    Cloth cloth(fabric(sheet.cook(cotton())), {}, sheet.positions);
    const Collider hips = capsule({-0.1f, 0, 0}, 0.1f, {0.1f, 0, 0}, 0.12f);
    const Collider turned = capsule({0.1f, 0, 0}, 0.1f, {-0.1f, 0, 0}, 0.12f);
    for (int frame = 0; frame < 40; ++frame) {
        cloth.step(kFrame_s, sheet.positions, std::vector{frame % 10 < 5 ? hips : turned}, *jobs);
        for (const Vec3& p : cloth.positions()) ASSERT_LT(glm::length(p), 0.5f) << frame;
    }
    EXPECT_LT(cloth.stats().strain_p99, 0.1f);
}

TEST(Contact, ShapeWhoseEndsAreTooCloseForAConeIsTheBiggerBall) {
    for (const float length : {0.0f, 1e-12f, 0.005f}) {
        const CapsuleShape shape({{0, 0, 0}, {length, 0, 0}, 0.1f, 0.11f});
        const NearestBall ball = nearest_ball(shape, {length, 0.2f, 0});
        EXPECT_NEAR(ball.distance, 0.09f, 1e-6f) << length;
        EXPECT_NEAR(ball.normal.y, 1.0f, 1e-6f) << length;
    }
}

TEST(Contact, ColliderWithoutExtentLeavesVerticesFinite) {
    const auto jobs = Jobs::own(0);
    ClothSettings settings = bare();
    settings.gravity = Vec3(0.0f);
    settings.substeps = 1;
    const std::vector<Vec3> start{{0, 0, 0}};
    Cloth cloth(lone_vertex(), settings, start);
    cloth.step(kFrame_s, start, std::vector{sphere({-1, 0, 0}, 0.0f)}, *jobs);
    cloth.step(kFrame_s, start, std::vector{sphere({1, 0, 0}, 0.0f)}, *jobs);  // right through it
    EXPECT_EQ(cloth.positions()[0], start[0]);
}

TEST(Contact, SheetFallsOnASphereAndStaysOutside) {
    const auto jobs = Jobs::own(0);
    Sheet sheet(20, 20, 0.02f);
    for (Vec3& p : sheet.positions) p = Vec3(p.x - 0.19f, 0.3f, p.y + 0.19f);
    ClothSettings settings;
    settings.thickness_m = 0.004f;
    Cloth cloth(fabric(sheet.cook(cotton())), settings, sheet.positions);
    const std::vector<Collider> ball{sphere({0, 0, 0}, 0.15f)};
    for (int frame = 0; frame < 120; ++frame) {
        cloth.step(kFrame_s, sheet.positions, ball, *jobs);
        for (const Vec3& p : cloth.positions()) ASSERT_GT(glm::length(p), 0.154f - 1e-4f);
    }
    EXPECT_NEAR(cloth.positions()[sheet.at(10, 10)].y, 0.154f, 0.02f);  // it lies there
}

/// A vertex on top of a long beam that is tilted along its length.
float slid_down(float tilt_rad, float friction) {
    const auto jobs = Jobs::own(0);
    const Vec3 along(std::cos(tilt_rad), std::sin(tilt_rad), 0.0f), up(-along.y, along.x, 0.0f);
    const std::vector<Vec3> start{up * 0.1f};
    ClothSettings settings = bare();
    settings.friction = friction;
    Cloth cloth(lone_vertex(), settings, start);
    const std::vector<Collider> beam{capsule(along * -5.0f, 0.1f, along * 5.0f, 0.1f)};
    for (int frame = 0; frame < 60; ++frame) cloth.step(kFrame_s, start, beam, *jobs);
    return -glm::dot(cloth.positions()[0] - start[0], along);
}

TEST(Contact, FrictionHoldsBelowItsConeAndSlidesAbove) {
    const float friction = 0.4f, angle = std::atan(friction);
    EXPECT_LT(slid_down(angle - 0.03f, friction), 1e-3f);
    const float tilt = angle + 0.2f;
    const float slid = slid_down(tilt, friction);
    EXPECT_GT(slid, 0.1f);
    // Sliding at g (sin - mu_k cos), kinetic friction below static but not absent.
    EXPECT_LT(slid, 0.5f * 9.81f * (std::sin(tilt) - 0.7f * friction * std::cos(tilt)));
    EXPECT_NEAR(slid_down(0.3f, 0.0f), 0.5f * 9.81f * std::sin(0.3f), 0.02f);
}

TEST(Contact, FrictionCarriesAVertexAlong) {
    const auto jobs = Jobs::own(0);
    const std::vector<Vec3> start{{0, 0.1f, 0}};
    ClothSettings settings = bare();
    settings.friction = 0.5f;
    Cloth cloth(lone_vertex(), settings, start);
    for (int frame = 0; frame <= 60; ++frame) {  // a beam drawn along at 0.3 m/s, gently enough not to slip
        const float x = 0.3f * float(frame) / 60.0f;
        cloth.step(kFrame_s, start, std::vector{capsule({x - 3, 0, 0}, 0.1f, {x + 3, 0, 0}, 0.1f)}, *jobs);
    }
    EXPECT_NEAR(cloth.positions()[0].x, 0.3f, 0.02f);
}

TEST(Contact, VertexThatBeganInsideComesOutSlowly) {
    const auto jobs = Jobs::own(0);
    ClothSettings settings = bare();
    settings.gravity = Vec3(0.0f);
    const std::vector<Vec3> start{{0.1f, 0, 0}};
    Cloth cloth(lone_vertex(), settings, start);
    const std::vector<Collider> ball{sphere({0, 0, 0}, 0.3f)};
    cloth.step(kFrame_s, start, ball, *jobs);
    EXPECT_LT(cloth.positions()[0].x - 0.1f, 0.06f);  // 3 m/s
    EXPECT_GT(cloth.positions()[0].x - 0.1f, 0.04f);
    for (int frame = 0; frame < 10; ++frame) cloth.step(kFrame_s, start, ball, *jobs);
    EXPECT_GE(cloth.positions()[0].x, 0.2999f);
}

TEST(Contact, BackstopKeepsItsVertexOutsideItsBall) {
    const auto jobs = Jobs::own(0);
    FabricData data;
    data.inverse_mass = {10.0f, 10.0f};
    data.backstops = {{0, 0.1f}};
    Cloth cloth(fabric(std::move(data)), bare(), std::vector<Vec3>{{0, 0.2f, 0}, {1, 0.2f, 0}});
    for (int frame = 0; frame < 60; ++frame) {
        const Vec3 center(0, 0.1f * std::sin(0.2f * float(frame)), 0);
        cloth.step(kFrame_s, std::vector<Vec3>{{}, {}, center}, {}, *jobs);
        ASSERT_GT(glm::length(cloth.positions()[0] - center), 0.1f - 1e-4f);
    }
    EXPECT_LT(cloth.positions()[1].y, -4.0f);  // the other one falls freely
}

}  // namespace
}  // namespace vfit
