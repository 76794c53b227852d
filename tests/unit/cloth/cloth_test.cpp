// The instance: determinism, hash, reset, teleport, refusals, and what a step costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cloth_support.h"
#include "support/allocations.h"

namespace vfit {
namespace {

using namespace test;

/// A curtain of 1,600 free vertices with a ball swung through it: several chunks of contacts.
struct Curtain {
    Sheet sheet{41, 40, 0.015f};
    std::shared_ptr<const Fabric> data;

    Curtain() {
        sheet.pin_top();
        data = fabric(sheet.cook(cotton()));
    }
    static std::vector<Collider> ball(int frame) {
        const float z = 0.3f * std::sin(0.15f * float(frame));
        return {sphere({0.3f, -0.3f, z}, 0.1f), capsule({0.1f, -0.5f, z}, 0.05f, {0.5f, -0.45f, z}, 0.03f)};
    }
};

TEST(Cloth, EqualBitsForAnyNumberOfWorkers) {
    const Curtain curtain;
    ASSERT_GT(curtain.data->simulated_count(), 1024u);
    std::vector<uint64_t> hashes;
    for (const uint32_t workers : {0u, 1u, 3u}) {
        const auto jobs = Jobs::own(workers);
        Cloth cloth(curtain.data, {}, curtain.sheet.positions);
        for (int frame = 0; frame < 60; ++frame)
            cloth.step(kFrame_s, curtain.sheet.positions, Curtain::ball(frame), *jobs);
        hashes.push_back(cloth.state_hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(Cloth, HashFollowsTheState) {
    const auto jobs = Jobs::own(0);
    const Curtain curtain;
    Cloth cloth(curtain.data, {}, curtain.sheet.positions);
    const uint64_t begin = cloth.state_hash();
    cloth.step(kFrame_s, curtain.sheet.positions, {}, *jobs);
    EXPECT_NE(cloth.state_hash(), begin);
    cloth.reset(curtain.sheet.positions);
    EXPECT_EQ(cloth.state_hash(), begin);
    std::vector<Vec3> moved = curtain.sheet.positions;
    moved.back().x = std::nextafter(moved.back().x, 10.0f);
    cloth.reset(moved);
    EXPECT_NE(cloth.state_hash(), begin);
}

TEST(Cloth, StepDoesNotAllocate) {
    const auto jobs = Jobs::own(1);
    const Curtain curtain;
    Cloth cloth(curtain.data, {}, curtain.sheet.positions);
    const auto colliders = Curtain::ball(0);
    cloth.step(kFrame_s, curtain.sheet.positions, colliders, *jobs);
    const uint64_t before = allocations;
    for (int frame = 0; frame < 30; ++frame) cloth.step(kFrame_s, curtain.sheet.positions, colliders, *jobs);
    const ClothStats stats = cloth.stats();
    EXPECT_EQ(allocations - before, 0u);
    EXPECT_GT(stats.step_ms, 0.0f);
}

TEST(Cloth, StepDoesNotAllocateWhenCollidersPart) {
    const auto jobs = Jobs::own(0);
    const Curtain curtain;
    Cloth cloth(curtain.data, {}, curtain.sheet.positions);
    const Collider limb = capsule({0.1f, -0.3f, 0.3f}, 0.05f, {0.5f, -0.3f, 0.3f}, 0.05f);
    // First the ball is an end of the capsule and not needed; then it is a collider of its own.
    const std::vector<Collider> joined{limb, sphere(limb.center, 0.05f)},
        parted{limb, sphere({0, -0.9f, 0}, 0.05f)};
    cloth.step(kFrame_s, curtain.sheet.positions, joined, *jobs);
    const uint64_t before = allocations;
    cloth.step(kFrame_s, curtain.sheet.positions, parted, *jobs);
    EXPECT_EQ(allocations - before, 0u);
}

TEST(Cloth, StepOfNextToNoTimeDoesNotShootTheClothAway) {
    const auto jobs = Jobs::own(0);
    const Curtain curtain;
    Cloth cloth(curtain.data, {}, curtain.sheet.positions);
    cloth.step(kFrame_s, curtain.sheet.positions, Curtain::ball(0), *jobs);
    for (const float dt : {1e-30f, 1e-20f, 1e-7f}) {
        std::vector<Vec3> targets = curtain.sheet.positions;
        for (Vec3& t : targets) t.z += 0.01f;
        cloth.step(dt, targets, Curtain::ball(2), *jobs);
    }
    for (int frame = 0; frame < 60; ++frame)
        cloth.step(kFrame_s, curtain.sheet.positions, Curtain::ball(2), *jobs);
    for (const Vec3& p : cloth.positions()) ASSERT_LT(glm::length(p), 2.0f);
    EXPECT_LT(cloth.stats().strain_p99, 0.1f);
}

TEST(Cloth, PutOnGoesTheWholeWayAndEndsAtRest) {
    const auto jobs = Jobs::own(0);
    const Curtain curtain;
    std::vector<float> shares;
    const auto body = [&](float share, std::vector<Vec3>& targets, std::vector<Collider>& colliders) {
        shares.push_back(share);
        targets = curtain.sheet.positions;
        for (Vec3& t : targets) t.x += 0.2f * share;
        colliders = {sphere({0.3f, -0.3f, 0.2f - 0.2f * share}, 0.1f)};
    };
    size_t calls = 0;
    for (const uint32_t substeps : {1u, 1000u}) {
        ClothSettings settings;
        settings.substeps = substeps;
        Cloth cloth(curtain.data, settings, curtain.sheet.positions);
        shares.clear();
        cloth.put_on(curtain.sheet.positions, body, *jobs);
        EXPECT_EQ(shares.front(), 0.0f);
        EXPECT_EQ(shares.back(), 1.0f);
        EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
        EXPECT_EQ(cloth.positions()[0], curtain.sheet.positions[0] + Vec3(0.2f, 0, 0));
        // The ball pushed the curtain before it.
        for (const Vec3& p : cloth.positions()) ASSERT_GT(glm::length(p - Vec3(0.3f, -0.3f, 0)), 0.1f);
        if (calls == 0) calls = shares.size();
        EXPECT_EQ(shares.size(), calls);  // what it costs does not depend on the settings
        EXPECT_LE(calls, 80u);
    }
}

TEST(Cloth, PutOnRefusesABodyThatIsNotFinite) {
    const auto jobs = Jobs::own(0);
    const Curtain curtain;
    Cloth cloth(curtain.data, {}, curtain.sheet.positions);
    const uint64_t begin = cloth.state_hash();
    const auto body = [&](float, std::vector<Vec3>& targets, std::vector<Collider>&) {
        targets = curtain.sheet.positions;
        targets[3].x = INFINITY;
    };
    EXPECT_EQ(error_of([&] { cloth.put_on(curtain.sheet.positions, body, *jobs); }),
              "-11 skinned targets 3 is not finite");
    EXPECT_EQ(cloth.state_hash(), begin);
}

TEST(Cloth, PinsFollowTheirTargets) {
    const auto jobs = Jobs::own(0);
    const Curtain curtain;
    Cloth cloth(curtain.data, {}, curtain.sheet.positions);
    std::vector<Vec3> targets = curtain.sheet.positions;
    for (Vec3& t : targets) t.z += 0.05f;
    cloth.step(kFrame_s, targets, {}, *jobs);
    EXPECT_EQ(cloth.positions()[0], targets[0]);
    EXPECT_NE(cloth.positions().back(), targets.back());  // free ones do not
}

TEST(Cloth, NothingMovesInNoTime) {
    const auto jobs = Jobs::own(0);
    const Curtain curtain;
    Cloth cloth(curtain.data, {}, curtain.sheet.positions);
    const uint64_t begin = cloth.state_hash();
    cloth.step(0.0f, curtain.sheet.positions, Curtain::ball(0), *jobs);
    EXPECT_EQ(cloth.state_hash(), begin);
}

TEST(Cloth, GoesAlongRigidlyWhenItsBodyIsTeleported) {
    const auto jobs = Jobs::own(0);
    const Curtain curtain;
    ClothSettings settings;
    settings.gravity = Vec3(0.0f);
    Cloth cloth(curtain.data, settings, curtain.sheet.positions);
    const Quat turn = glm::angleAxis(2.5f, glm::normalize(Vec3(0.2f, 1.0f, 0.1f)));
    std::vector<Vec3> targets = curtain.sheet.positions;
    for (Vec3& t : targets) t = Vec3(3, 1, -2) + turn * t;
    // A wall of a ball stands on the way: a jump is not swept through it.
    cloth.step(kFrame_s, curtain.sheet.positions, std::vector{sphere({1.5f, 0.5f, -1}, 0.5f)}, *jobs);
    cloth.step(kFrame_s, targets, std::vector{sphere({1.5f, 0.5f, -1}, 0.5f)}, *jobs);
    // The pins lie in a line, about which their jump says nothing: lengths and strain tell.
    EXPECT_LT(cloth.stats().strain_max, 1e-3f);
    for (size_t i = 0; i < targets.size(); ++i)
        ASSERT_NEAR(glm::length(cloth.positions()[i] - targets[0]),
                    glm::length(curtain.sheet.positions[i] - curtain.sheet.positions[0]), 2e-3f);
}

TEST(Cloth, TeleportTurnsTheClothWithAClosedRowOfPins) {
    const auto jobs = Jobs::own(0);
    Sheet sheet(12, 12, 0.02f);
    sheet.pin_top();
    for (uint32_t r = 0; r < sheet.rows; ++r) sheet.simulated[sheet.at(r, 0)] = 0;  // two sides: a plane
    ClothSettings settings;
    settings.gravity = Vec3(0.0f);
    Cloth cloth(fabric(sheet.cook(cotton())), settings, sheet.positions);
    for (const float angle : {0.3f, 1.6f, kPi}) {
        const Quat turn = glm::angleAxis(angle, Vec3(0, 1, 0));
        std::vector<Vec3> targets = sheet.positions;
        for (Vec3& t : targets) t = Vec3(3 + angle, 1, -2) + turn * t;
        cloth.reset(sheet.positions);
        cloth.step(kFrame_s, targets, {}, *jobs);
        for (size_t i = 0; i < targets.size(); ++i)
            ASSERT_LT(glm::length(cloth.positions()[i] - targets[i]), 1e-4f) << "turned by " << angle;
    }
}

TEST(Cloth, RefusesWhatIsNotFiniteAndStaysAsItWas) {
    const auto jobs = Jobs::own(0);
    const Curtain curtain;
    Cloth cloth(curtain.data, {}, curtain.sheet.positions);
    const uint64_t begin = cloth.state_hash();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<Vec3> targets = curtain.sheet.positions;
    targets[7].y = nan;
    EXPECT_EQ(error_of([&] { cloth.step(kFrame_s, targets, {}, *jobs); }),
              "-11 skinned targets 7 is not finite");
    auto ball = Curtain::ball(0);
    ball[1].center_b.x = INFINITY;
    EXPECT_EQ(error_of([&] { cloth.step(kFrame_s, curtain.sheet.positions, ball, *jobs); }),
              "-11 collider 1 is not finite");
    ball = Curtain::ball(0);
    ball[0].radius = -0.1f;
    EXPECT_EQ(error_of([&] { cloth.step(kFrame_s, curtain.sheet.positions, ball, *jobs); }),
              "-11 collider 0 has a negative radius");
    EXPECT_EQ(error_of([&] { cloth.step(nan, curtain.sheet.positions, {}, *jobs); }).substr(0, 2), "-2");
    EXPECT_EQ(error_of([&] { cloth.step(-0.1f, curtain.sheet.positions, {}, *jobs); }).substr(0, 2), "-2");
    targets = curtain.sheet.positions;
    targets.pop_back();
    EXPECT_EQ(error_of([&] { cloth.step(kFrame_s, targets, {}, *jobs); }),
              "-2 1639 skinned targets for a garment of 1640 vertices");
    EXPECT_EQ(error_of([&] { cloth.reset(targets); }).substr(0, 2), "-2");
    EXPECT_EQ(cloth.state_hash(), begin);
}

TEST(Cloth, RefusesSettingsWithoutSense) {
    const Curtain curtain;
    const auto with = [&](auto change) {
        ClothSettings settings;
        change(settings);
        return error_of([&] { Cloth(curtain.data, settings, curtain.sheet.positions); }).substr(0, 2);
    };
    EXPECT_EQ(with([](ClothSettings&) {}), "");
    EXPECT_EQ(with([](ClothSettings& s) { s.substeps = 0; }), "-2");
    EXPECT_EQ(with([](ClothSettings& s) { s.damping = 1.5f; }), "-2");
    EXPECT_EQ(with([](ClothSettings& s) { s.friction = -1.0f; }), "-2");
    EXPECT_EQ(with([](ClothSettings& s) { s.gravity.y = INFINITY; }), "-2");
    EXPECT_EQ(with([](ClothSettings& s) { s.thickness_m = -0.01f; }), "-2");
}

}  // namespace
}  // namespace vfit
