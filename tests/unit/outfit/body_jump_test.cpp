// Jumps of the body: by the bones that carry the garment, as if the cloth had hung there before.
#include "outfit/body_jump.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "support/allocations.h"
#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;

Mat4 turned(const Vec3& axis, float angle_rad, const Vec3& about) {
    return glm::translate(Mat4(1.0f), about) * glm::rotate(Mat4(1.0f), angle_rad, glm::normalize(axis)) *
           glm::translate(Mat4(1.0f), -about);
}
Mat4 shifted(const Vec3& way) { return glm::translate(Mat4(1.0f), way); }
Vec3 moved(const Mat4& m, const Vec3& p) { return Vec3(m * Vec4(p, 1.0f)); }

std::vector<Mat4> all(const Mat4& motion, const std::vector<Mat4>& pose) {
    std::vector<Mat4> out;
    for (const Mat4& bone : pose) out.push_back(motion * bone);
    return out;
}

/// A sheet that hangs from two bones, its upper rows by the first, its lower ones by the second.
struct Worn {
    Sheet sheet{20, 12, 0.02f};
    std::shared_ptr<const Fabric> data;
    std::vector<SkinBones> bones;
    std::vector<SkinWeights> weights;
    std::unique_ptr<Carry> carry;
    std::unique_ptr<BodyJump> body;
    std::vector<Mat4> pose = {Mat4(1.0f), Mat4(1.0f)};
    std::vector<Vec3> targets;
    std::unique_ptr<Jobs> jobs;
    std::unique_ptr<Cloth> cloth;
    ClothSettings settings;
    uint32_t mesh = 0;
    bool with_mesh = false;

    explicit Worn(const ClothSettings& given = {}, unsigned workers = 0) : settings(given) {
        settings.follows_fixed = false;
        sheet.pin_top();
        data = fabric(sheet.cook(cotton()));
        for (const Vec3& p : sheet.positions) {
            const float lower = std::clamp(-p.y / 0.38f, 0.0f, 1.0f);
            bones.push_back({0, 1});
            weights.push_back({1.0f - lower, lower});
        }
        carry = std::make_unique<Carry>(bones, weights);
        body = std::make_unique<BodyJump>(*carry, sheet.positions);
        body->stand(pose);
        targets = sheet.positions;
        jobs = Jobs::own(workers);
        cloth = std::make_unique<Cloth>(data, settings, sheet.positions);
    }
    /// A wall behind the sheet.
    void add_wall() {
        mesh = cloth->add_mesh(3, std::vector<uint32_t>{0, 1, 2});
        with_mesh = true;
    }
    void step(bool jumps = false, const std::vector<Collider>& colliders = {}) {
        body->move_to(pose, kFrame_s);
        jumps = jumps || settings.is_jump(body->way(), kFrame_s);
        const float fraction = jumps ? 1.0f : 1.0f - settings.inertia;
        if (body->moves() && (fraction > 0.0f || body->follows_jump())) {
            body->carry(cloth->positions(), fraction, *jobs);
            cloth->carry_along({fraction, body->places(), body->turns(), body->speeds(), body->is_rigid()});
        }
        for (uint32_t c = 0; c < sheet.columns; ++c) targets[c] = moved(pose[0], sheet.positions[c]);
        if (with_mesh)
            cloth->move_mesh(
                mesh, std::vector<Vec3>{moved(pose[0], {-1, -2, -0.05f}), moved(pose[0], {1, -2, -0.05f}),
                                        moved(pose[0], {0, 1, -0.05f})});
        cloth->step(kFrame_s, targets, colliders, *jobs);
    }
    void step(int times) {
        for (int i = 0; i < times; ++i) step();
    }
};

float furthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const Mat4& motion = Mat4(1.0f)) {
    float most = 0.0f;
    for (size_t i = 0; i < a.size(); ++i) most = std::max(most, glm::length(moved(motion, a[i]) - b[i]));
    return most;
}

const Mat4 kFar = shifted({2, 0.1f, -0.7f}) * turned({0, 1, 0}, 2.2f, {0.1f, 0, 0.4f});

TEST(BodyJump, ClothGoesOnAsIfItHadHungThereBefore) {
    Worn stays, jumps;
    stays.add_wall(), jumps.add_wall();
    // Both swing when one of them jumps.
    for (Worn* worn : {&stays, &jumps}) {
        for (int i = 0; i < 15; ++i) worn->pose = all(shifted({0, 0, 0.01f}), worn->pose), worn->step();
        worn->step(5);
    }
    jumps.pose = all(kFar, jumps.pose);
    for (int i = 0; i < 60; ++i) {
        stays.step(), jumps.step();
        ASSERT_LT(furthest(stays.cloth->positions(), jumps.cloth->positions(), kFar), 2e-3f) << i;
    }
}

TEST(BodyJump, NothingIsSweptThroughTheCloth) {
    Worn worn;
    const auto ball = [&] { return std::vector{sphere(moved(worn.pose[0], {0.1f, -0.2f, -0.1f}), 0.08f)}; };
    for (int i = 0; i < 60; ++i) worn.step(false, ball());
    const std::vector<Vec3> before = worn.cloth->positions();
    const Mat4 across = shifted({0, 0, -0.5f});  // the ball would come out on the other side
    worn.pose = all(across, worn.pose);
    worn.step(false, ball());
    EXPECT_LT(furthest(before, worn.cloth->positions(), across), 2e-3f);
}

TEST(BodyJump, ALimbThatLeapsTakesItsPartAlone) {
    Worn worn;
    worn.step(30);
    const std::vector<Vec3> before = worn.cloth->positions();
    worn.pose[1] = turned({1, 0, 0}, 0.8f, {0, 0, 0});
    worn.step();
    const uint32_t top = worn.sheet.at(1, 6), bottom = worn.sheet.at(19, 6);
    EXPECT_LT(glm::distance(worn.cloth->positions()[top], before[top]), 0.02f);
    EXPECT_GT(glm::distance(worn.cloth->positions()[bottom], before[bottom]), 0.2f);
    EXPECT_FALSE(worn.body->is_rigid());
}

TEST(BodyJump, TheWholeAndItsLimbsAreToldApart) {
    Worn worn;
    // The lowest row, 0.38 m below, goes 0.19 m.
    worn.pose[1] = turned({1, 0, 0}, 0.5f, {0, 0, 0});
    worn.body->move_to(worn.pose, kFrame_s);
    const BodyWay& way = worn.body->way();
    EXPECT_NEAR(way.whole_m + way.limb_m, 2.0f * std::sin(0.25f) * 0.38f, 0.1f);
    EXPECT_GT(way.limb_m, 0.03f);
    // Turned as a whole, no limb moves against it.
    worn.body->stand(worn.pose);
    worn.body->move_to(worn.pose = all(turned({0, 1, 0}, 0.5f, {0, 0, 0}), worn.pose), kFrame_s);
    EXPECT_GT(way.whole_m, 0.03f);
    EXPECT_LT(way.limb_m, 1e-4f);
    const ClothSettings settings;
    const float all_m = 1.01f * kCarryWay_m, fast_m = 1.01f * kCarrySpeed_m_s / 240.0f;
    EXPECT_TRUE(settings.is_jump({all_m, all_m, 0.0f}, 1.0f / 30.0f));
    EXPECT_FALSE(settings.is_jump({0.98f * all_m, all_m, all_m}, 1.0f / 30.0f));  // a limb that swings
    EXPECT_TRUE(settings.is_jump({0.0f, fast_m, 0.0f}, 1.0f / 240.0f));
    EXPECT_TRUE(settings.is_jump({0.0f, 0.0f, fast_m}, 1.0f / 240.0f));
    EXPECT_FALSE(settings.is_jump({0.0f, 0.98f * fast_m, 0.98f * fast_m}, 1.0f / 240.0f));
}

TEST(BodyJump, MotionOfTheBodyIsTakenOutInAJumpAndGivenBackAfter) {
    Worn worn;
    const Vec3 walk(0.02f, 0, 0), run(0, 0, 0.05f);
    worn.body->move_to(worn.pose = all(shifted(walk), worn.pose), kFrame_s);
    const Mat4 turn = turned({0, 1, 0}, 1.5f, {0, 0, 0});
    worn.body->move_to(worn.pose = all(turn, worn.pose), kFrame_s);
    worn.body->carry(worn.sheet.positions, 1.0f, *worn.jobs);
    for (const Vec3& speed : worn.body->speeds())
        ASSERT_LT(glm::length(speed + Mat3(turn) * walk / kFrame_s), 1e-4f);
    worn.body->move_to(worn.pose = all(shifted(run), worn.pose), kFrame_s);
    ASSERT_TRUE(worn.body->follows_jump());
    worn.body->carry(worn.sheet.positions, 0.0f, *worn.jobs);
    EXPECT_EQ(furthest(worn.sheet.positions, {worn.body->places().begin(), worn.body->places().end()}), 0.0f);
    for (const Vec3& speed : worn.body->speeds()) ASSERT_LT(glm::length(speed - run / kFrame_s), 1e-4f);
}

TEST(BodyJump, JumpAfterJumpLeavesTheClothWhereItIsOnTheBody) {
    Worn worn;
    worn.step(30);
    const std::vector<Vec3> before = worn.cloth->positions();
    Mat4 motion(1.0f);
    for (int i = 0; i < 20; ++i) {
        const Mat4 leap = shifted({0.4f, 0, 0.1f}) * turned({0, 1, 0}, 0.3f, {0, 0, 0});
        motion = leap * motion;
        worn.pose = all(leap, worn.pose);
        worn.step();
    }
    EXPECT_LT(furthest(before, worn.cloth->positions(), motion), 0.01f);
}

TEST(BodyJump, WhatTheClothDoesNotFeelOfALimbIsThatLimbsOwn) {
    const auto lag = [](float inertia) {
        ClothSettings settings;
        settings.inertia = inertia;
        Worn worn(settings);
        worn.add_wall();
        worn.step(10);
        for (int i = 1; i <= 10; ++i)
            worn.pose[1] = turned({1, 0, 0}, -0.05f * float(i), {0, 0, 0}), worn.step();
        const uint32_t bottom = worn.sheet.at(19, 6);
        return moved(worn.pose[1], worn.sheet.positions[bottom]).z - worn.cloth->positions()[bottom].z;
    };
    const float real = lag(1.0f), none = lag(0.0f);
    EXPECT_GT(real, 0.15f) << "it hangs from the upper row";
    EXPECT_LT(std::abs(none), 0.4f * real);
}

TEST(BodyJump, WhatSleepsIsCarriedAsleep) {
    Worn worn;
    worn.step(1200);
    ASSERT_EQ(worn.cloth->stats().substeps, 0u) << "asleep";
    const std::vector<Vec3> before = worn.cloth->positions();
    worn.pose = all(kFar, worn.pose);
    worn.step();
    EXPECT_EQ(worn.cloth->stats().substeps, 0u);
    EXPECT_LT(furthest(before, worn.cloth->positions(), kFar), 1e-5f);
    worn.step(3);
    EXPECT_EQ(worn.cloth->stats().substeps, 0u) << "and sleeps on";
    worn.pose = all(turned({1, 0, 0}, 1.5f, {0, 0, 0}), worn.pose);
    worn.step();
    EXPECT_GT(worn.cloth->stats().substeps, 0u) << "laid down, it falls";
}

TEST(BodyJump, ALimbThatLeapsWakesIt) {
    Worn worn;
    worn.step(1200);
    ASSERT_EQ(worn.cloth->stats().substeps, 0u);
    worn.pose[1] = shifted({0.3f, 0, 0});
    worn.step();
    EXPECT_GT(worn.cloth->stats().substeps, 0u);
}

TEST(BodyJump, EqualBitsForAnyNumberOfWorkers) {
    const auto hash = [](unsigned workers, float inertia) {
        ClothSettings settings;
        settings.inertia = inertia;
        Worn worn(settings, workers);
        worn.add_wall();
        for (int i = 0; i < 20; ++i) {
            worn.pose[1] = turned({1, 0, 0.2f}, 0.03f * float(i), {0, 0, 0}) * worn.pose[0];
            if (i % 7 == 3) worn.pose = all(kFar, worn.pose);
            worn.step();
        }
        return worn.cloth->state_hash();
    };
    for (const float inertia : {1.0f, 0.4f}) {
        const uint64_t alone = hash(0, inertia);
        for (const unsigned workers : {1u, 3u}) EXPECT_EQ(hash(workers, inertia), alone) << workers;
    }
}

TEST(BodyJump, DoesNotAllocateAfterTheFirst) {
    ClothSettings settings;
    settings.inertia = 0.5f;
    Worn worn(settings);
    const auto frame = [&](int i) {
        worn.pose = all(i % 3 ? shifted({0.01f, 0, 0}) : kFar, worn.pose);
        worn.body->move_to(worn.pose, kFrame_s);
        const float fraction = settings.is_jump(worn.body->way(), kFrame_s) ? 1.0f : 0.5f;
        worn.body->carry(worn.cloth->positions(), fraction, *worn.jobs);
        worn.cloth->carry_along({fraction, worn.body->places(), worn.body->turns(), worn.body->speeds()});
        worn.cloth->step(kFrame_s, worn.targets, {}, *worn.jobs);
    };
    std::vector<Mat4> room;
    for (int i = 0; i < 6; ++i) frame(i);
    const uint64_t own = [&] {  // of the test's own poses
        const uint64_t before = allocations;
        for (int i = 0; i < 6; ++i) room = all(kFar, worn.pose);
        return allocations - before;
    }();
    const uint64_t before = allocations;
    for (int i = 6; i < 12; ++i) frame(i);
    EXPECT_EQ(allocations - before, own);
}

TEST(BodyJump, RefusesAWrongNumberOfPlaces) {
    Worn worn;
    EXPECT_NE(error_of([&] { BodyJump(*worn.carry, std::vector<Vec3>(3)); }).find("3 places"),
              std::string::npos);
    worn.body->move_to(worn.pose, kFrame_s);
    EXPECT_NE(error_of([&] { worn.body->carry(std::vector<Vec3>(7), 1.0f, *worn.jobs); }).find("7 places"),
              std::string::npos);
    EXPECT_NE(
        error_of([&] { worn.cloth->carry_along({1.0f, std::vector<Vec3>(7), {}, {}}); }).find("7 places"),
        std::string::npos);
}

}  // namespace
}  // namespace vfit
