// What a cloth can do beside hanging: air, distance limits, inertia, sleep, a time budget.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cloth/contact/virtual_particles.h"
#include "cloth_support.h"

namespace vfit {
namespace {

using namespace test;

Vec3 mean(const std::vector<Vec3>& points) {
    Vec3 sum(0.0f);
    for (const Vec3& p : points) sum += p / float(points.size());
    return sum;
}

/// A flat sheet that falls, face down or on a slope, in air.
struct Falling {
    Sheet sheet{12, 12, 0.02f};
    std::unique_ptr<Cloth> cloth;
    std::unique_ptr<Jobs> jobs = Jobs::own(0);
    std::vector<Vec3> start;

    Falling(const Air& air, float slope) {
        for (const Vec3& p : sheet.positions) start.emplace_back(p.x, 10.0f + slope * p.y, p.y);
        ClothSettings settings;
        settings.damping = 0.0f;
        settings.air = air;
        FabricMaterial stiff = cotton();
        stiff.bend_n_m = 10.0f;  // a board
        cloth = std::make_unique<Cloth>(fabric(sheet.cook(stiff)), settings, start);
    }
    void run(float seconds) {
        for (int i = 0; i < int(60.0f * seconds); ++i) cloth->step(kFrame_s, start, {}, *jobs);
    }
};

double mean(const std::vector<float>& numbers) {
    double sum = 0.0;
    for (const float number : numbers) sum += number;
    return sum / double(numbers.size());
}

TEST(ClothPressure, WhatLiesPressesWithItsWeight) {
    const auto jobs = Jobs::own(0);
    const Sheet sheet(20, 20, 0.02f);
    std::vector<Vec3> start;
    for (const Vec3& p : sheet.positions) start.emplace_back(p.x, 0.006f, p.y);
    ClothSettings settings;
    settings.friction = 0.0f;
    settings.sleeps = false;
    settings.pressure = true;
    Cloth cloth(fabric(sheet.cook(cotton())), settings, start);
    const std::vector<Collider> floor{sphere({0.0f, -50.0f, 0.0f}, 50.0f)};
    EXPECT_EQ(mean(cloth.pressure()), 0.0);
    for (int frame = 0; frame < 60; ++frame) cloth.step(kFrame_s, start, floor, *jobs);
    EXPECT_NEAR(mean(cloth.pressure()), 0.2 * 9.81, 0.02 * 0.2 * 9.81);
    for (const int substeps : {4, 16}) {
        cloth.set_quality(uint32_t(substeps), 0.0f);
        for (int frame = 0; frame < 30; ++frame) cloth.step(kFrame_s, start, floor, *jobs);
        EXPECT_NEAR(mean(cloth.pressure()), 0.2 * 9.81, 0.02 * 0.2 * 9.81) << substeps;
    }
}

TEST(ClothPressure, ATubeThatIsTooNarrowPressesByLaplacesLaw) {
    const auto jobs = Jobs::own(0);
    constexpr uint32_t kRound = 48, kRows = 12;
    constexpr float kRadius_m = 0.1f, kTooNarrow = 0.95f;
    std::vector<Vec3> start;
    std::vector<uint32_t> indices;
    for (uint32_t r = 0; r < kRows; ++r)
        for (uint32_t c = 0; c < kRound; ++c) {
            const float angle = 6.2831853f * float(c) / float(kRound);
            start.emplace_back(kRadius_m * std::cos(angle), -0.013f * float(r), kRadius_m * std::sin(angle));
            if (r + 1 == kRows) continue;
            const uint32_t a = r * kRound + c, b = r * kRound + (c + 1) % kRound, d = a + kRound,
                           e = b + kRound;
            indices.insert(indices.end(), {a, b, d, b, e, d});
        }
    const std::vector<uint8_t> simulated(start.size(), 1);
    FabricMaterial knit = cotton();
    knit.shear_n_m = 1.0f;  // so that only what goes around carries
    ClothSettings settings;
    settings.gravity = Vec3(0.0f);
    settings.thickness_m = 0.0f;
    settings.friction = 0.0f;
    settings.sleeps = false;
    settings.pressure = true;
    settings.substeps = 16;
    Cloth cloth(fabric(cook_fabric({start, indices, {}, simulated, kTooNarrow}, knit)), settings, start);
    const std::vector<Collider> post{capsule({0, 1, 0}, kRadius_m, {0, -1, 0}, kRadius_m)};
    for (int frame = 0; frame < 120; ++frame) cloth.step(kFrame_s, start, post, *jobs);
    double inner = 0.0;
    for (uint32_t i = 4 * kRound; i < 8 * kRound; ++i) inner += cloth.pressure()[i] / (4.0 * kRound);
    const double tension_n_m = 2000.0 * (1.0 / kTooNarrow - 1.0);
    // Area is that of the flat cloth, which is narrower.
    EXPECT_NEAR(inner * kTooNarrow, tension_n_m / kRadius_m, 0.1 * tension_n_m / kRadius_m);
}

TEST(ClothAir, ASheetThatFallsFlatReachesThePlatesTerminalSpeed) {
    Falling falling({Vec3(0.0f), 1.2f, 0.0f}, 0.0f);
    falling.run(1.0f);
    const float before = mean(falling.cloth->positions()).y;
    falling.run(0.5f);
    const float speed = 2.0f * (before - mean(falling.cloth->positions()).y);
    // m g = rho / 2 c A v^2
    EXPECT_NEAR(speed, std::sqrt(2.0f * 0.2f * 9.81f / (1.2f * 1.2f)), 0.05f);
}

TEST(ClothAir, ALeaningSheetGlidesToTheSide) {
    Falling without({Vec3(0.0f), 1.0f, 0.0f}, 0.5f), with({Vec3(0.0f), 1.0f, 1.0f}, 0.5f);
    const float start = mean(with.start).z;
    without.run(0.3f);
    with.run(0.3f);
    EXPECT_LT(std::abs(mean(without.cloth->positions()).z - start), 0.01f);
    EXPECT_GT(std::abs(mean(with.cloth->positions()).z - start), 0.03f);
}

TEST(ClothAir, AGaleMovesAClothNoFasterThanItself) {
    Falling falling({Vec3(0, 0, 20.0f), 1e6f, 0.0f}, 1.0f);
    const float start = mean(falling.start).z;
    falling.run(0.5f);
    const float way = mean(falling.cloth->positions()).z - start;
    EXPECT_GT(way, 5.0f);
    EXPECT_LT(way, 10.5f);
}

/// A curtain that hangs.
struct Hanging {
    Sheet sheet{20, 15, 0.02f};
    std::unique_ptr<Jobs> jobs = Jobs::own(0);
    std::unique_ptr<Cloth> cloth;
    std::vector<Vec3> targets;

    explicit Hanging(const ClothSettings& settings = {}, const std::vector<DistanceLimit>& limits = {}) {
        sheet.pin_top();
        targets = sheet.positions;
        FabricData data = sheet.cook(cotton());
        data.limits = limits;
        cloth = std::make_unique<Cloth>(fabric(std::move(data)), settings, sheet.positions);
    }
    void step(int frames, const std::vector<Collider>& colliders = {}) {
        for (int i = 0; i < frames; ++i) cloth->step(kFrame_s, targets, colliders, *jobs);
    }
    const Vec3& lowest(uint32_t column) const { return cloth->positions()[sheet.at(sheet.rows - 1, column)]; }
};

TEST(ClothAir, WindBlowsACurtainAside) {
    Hanging hanging;
    hanging.cloth->set_air({Vec3(0, 0, 5.0f), 1.0f, 0.5f});
    hanging.step(60);
    EXPECT_GT(hanging.lowest(7).z, 0.05f);
    EXPECT_NE(test::error_of([&] { hanging.cloth->set_air({Vec3(NAN, 0, 0), 1.0f, 0.0f}); }), "");
    EXPECT_NE(test::error_of([&] { hanging.cloth->set_air({Vec3(0.0f), -1.0f, 0.0f}); }), "");
}

TEST(ClothLimits, AVertexStaysAsNearToItsTargetAsItIsTold) {
    std::vector<DistanceLimit> limits;
    for (uint32_t v = 15; v < 20 * 15; ++v)
        if (v % 15 < 8) limits.push_back({v, 0.01f});
    Hanging hanging({}, limits);
    hanging.cloth->set_air({Vec3(0, 0, 8.0f), 1.0f, 0.0f});
    hanging.step(120);
    for (const DistanceLimit& limit : limits)
        EXPECT_LT(glm::length(hanging.cloth->positions()[limit.vertex] - hanging.targets[limit.vertex]),
                  0.0101f);
    EXPECT_GT(hanging.lowest(14).z, 0.05f) << "the others blow";
    FabricData data = hanging.sheet.cook(cotton());
    data.limits = {{0, 0.1f}};
    EXPECT_NE(test::error_of([&] { Fabric bad(data); }).find("greatest distance of vertex 0"),
              std::string::npos);
}

TEST(ClothLimits, AVertexStaysAsNearToTheTargetOfAnotherAsItIsTold) {
    constexpr uint32_t kTwoRowsBelow = 30;
    Hanging hanging({}, {{kTwoRowsBelow, 0.03f, 0}});
    hanging.step(60);
    EXPECT_LT(glm::distance(hanging.cloth->positions()[kTwoRowsBelow], hanging.targets[0]), 0.0301f);
    FabricData data = hanging.sheet.cook(cotton());
    data.limits = {{kTwoRowsBelow, 0.03f, 300}};
    EXPECT_NE(test::error_of([&] { Fabric bad(data); }).find("from target 300"), std::string::npos);
}

TEST(ClothLimits, TheyPullByNoMoreThanTheyAreTold) {
    // The wind and what hangs at a vertex pull by more than twice its weight.
    const auto off_m = [](float pull_m_s2) {
        std::vector<DistanceLimit> limits;
        for (uint32_t v = 15; v < 30; ++v) limits.push_back({v, 0.005f, v, pull_m_s2});
        Hanging hanging({}, limits);
        hanging.cloth->set_air({Vec3(0, 0, 8.0f), 1.0f, 0.0f});
        hanging.step(120);
        float max_m = 0.0f;
        for (const DistanceLimit& limit : limits)
            max_m = std::max(max_m, glm::distance(hanging.cloth->positions()[limit.vertex],
                                                  hanging.targets[limit.vertex]));
        return max_m;
    };
    EXPECT_LT(off_m(1e5f), 0.0051f);
    EXPECT_GT(off_m(20.0f), 0.007f);
    EXPECT_NE(test::error_of([&] { off_m(-1.0f); }).find("vertex 15 pulls by -1"), std::string::npos);
    EXPECT_NE(test::error_of([&] { off_m(NAN); }).find("vertex 15 pulls by"), std::string::npos);
}

TEST(ClothLimits, WidenedTheyHoldItFurtherOff) {
    std::vector<DistanceLimit> limits;
    for (uint32_t v = 15; v < 20 * 15; ++v) limits.push_back({v, 0.01f});
    Hanging hanging({}, limits);
    hanging.cloth->set_air({Vec3(0, 0, 8.0f), 1.0f, 0.0f});
    const auto farthest = [&](const Cloth& cloth) {
        float max_m = 0.0f;
        for (const DistanceLimit& limit : limits)
            max_m = std::max(max_m,
                             glm::distance(cloth.positions()[limit.vertex], hanging.targets[limit.vertex]));
        return max_m;
    };
    hanging.cloth->widen_limits(std::vector<float>(300, 0.02f));
    hanging.step(120);
    EXPECT_NEAR(farthest(*hanging.cloth), 0.03f, 1e-4f);
    FabricData data = hanging.sheet.cook(cotton());
    data.limits = limits;
    *hanging.cloth = hanging.cloth->with_fabric(fabric(std::move(data)));
    hanging.step(60);
    EXPECT_NEAR(farthest(*hanging.cloth), 0.03f, 1e-4f) << "of another fabric too";
    EXPECT_EQ(test::error_of([&] { hanging.cloth->widen_limits(std::vector<float>(299)); }).substr(0, 3),
              "-2 ");
}

TEST(ClothInertia, WhatIsNotFeltCarriesTheClothAlong) {
    const auto sway = [](float inertia) {
        ClothSettings settings;
        settings.inertia = inertia;
        Hanging hanging(settings);
        for (int i = 0; i < 30; ++i) {
            for (Vec3& t : hanging.targets) t.z += 0.02f;  // 1.2 m/s at once
            hanging.step(1);
        }
        return hanging.targets[0].z - hanging.lowest(7).z;
    };
    const float real = sway(1.0f), half = sway(0.5f), none = sway(0.0f);
    EXPECT_GT(real, 0.05f);
    EXPECT_LT(half, 0.8f * real);
    EXPECT_LT(std::abs(none), 0.002f);
}

TEST(ClothInertia, TurnsAreNotFeltEither) {
    ClothSettings settings;
    settings.inertia = 0.0f;
    Hanging hanging(settings);
    hanging.step(60);
    const Vec3 before = hanging.lowest(14) - hanging.lowest(0);
    const Quat turn = glm::angleAxis(0.05f, Vec3(0, 1, 0));
    for (int i = 0; i < 30; ++i) {
        for (Vec3& t : hanging.targets) t = turn * t;
        hanging.step(1);
    }
    const Vec3 after = hanging.lowest(14) - hanging.lowest(0);
    EXPECT_LT(glm::length(after - glm::angleAxis(1.5f, Vec3(0, 1, 0)) * before), 0.01f);
}

TEST(ClothSleep, WhatLiesStillIsNotSteppedAndWakesWhenSomethingMoves) {
    Hanging hanging;
    const std::vector<Collider> ball{sphere({0.14f, -0.2f, 0.2f}, 0.05f)};
    hanging.step(1200, ball);
    EXPECT_EQ(hanging.cloth->stats().substeps, 0u) << "asleep";
    const uint64_t asleep = hanging.cloth->state_hash();
    hanging.step(10, ball);
    EXPECT_EQ(hanging.cloth->state_hash(), asleep);
    // The ball comes by small steps.
    std::vector<Collider> moving = ball;
    for (int i = 0; i < 100; ++i) {
        moving[0].center.z -= 0.0017f;
        hanging.step(1, moving);
    }
    EXPECT_LT(hanging.lowest(7).z, -0.002f) << "pushed";
    hanging.step(1200, moving);
    EXPECT_EQ(hanging.cloth->stats().substeps, 0u);
    for (Vec3& t : hanging.targets) t.x += 0.001f;
    hanging.step(1, moving);
    EXPECT_EQ(hanging.cloth->stats().substeps, 8u) << "its targets have moved";
    hanging.step(1200, moving);
    EXPECT_EQ(hanging.cloth->stats().substeps, 0u);
    std::vector<Collider> more = moving;
    more.push_back(sphere({0.1f, -0.3f, 0.0f}, 0.05f));
    hanging.step(1, more);
    EXPECT_EQ(hanging.cloth->stats().substeps, 8u) << "a ball has appeared";
    ClothSettings awake;
    awake.sleeps = false;
    Hanging never(awake);
    never.step(1200);
    EXPECT_EQ(never.cloth->stats().substeps, 8u);
}

TEST(ClothSleep, IsAPauseThatLosesNothing) {
    // Where velocities were lost, contact would not see who is drawn to the body.
    ClothSettings awake;
    awake.sleeps = false;
    Hanging sleeper, never(awake);
    const std::vector<Collider> ball{sphere({0.14f, -0.2f, 0.2f}, 0.05f)};
    uint64_t before = 0;
    for (int frame = 0; frame < 1200; ++frame) {
        sleeper.step(1, ball);
        if (sleeper.cloth->stats().substeps == 0) break;
        never.step(1, ball);
        before = never.cloth->state_hash();
    }
    ASSERT_EQ(sleeper.cloth->stats().substeps, 0u) << "asleep";
    EXPECT_EQ(sleeper.cloth->state_hash(), before);
}

TEST(ClothSleep, BeginsBetweenTheTwoStepsOfOneInHaste) {
    Sheet sheet(9, 5, 0.02f);
    sheet.pin_top();
    const auto jobs = Jobs::own(0);
    std::set<uint32_t> last;  // sub-steps of the last step before it sleeps
    for (const float first_s : {1.0f / 60.0f, 1.0f / 120.0f, 1.0f / 90.0f}) {
        Cloth cloth(fabric(sheet.cook(cotton())), {}, sheet.positions);
        cloth.come_to_lengths(
            [&](float, std::vector<Vec3>& targets, std::vector<Collider>&) { targets = sheet.positions; },
            *jobs);
        cloth.step(first_s, sheet.positions, {}, *jobs);
        uint32_t substeps = 0;
        for (int frame = 0; frame < 40 && cloth.stats().substeps > 0; ++frame) {
            substeps = cloth.stats().substeps;
            cloth.step(kFrame_s, sheet.positions, {}, *jobs);
        }
        ASSERT_EQ(cloth.stats().substeps, 0u) << "asleep while it is in haste";
        last.insert(substeps);
    }
    EXPECT_TRUE(last.count(8)) << "one step of 8 sub-steps, and not both";
}

TEST(ClothLengths, WhatComesToThemHangsStillWithinASecond) {
    Sheet sheet(9, 5, 0.1f);  // 0.8 m, as a coat below the waist
    sheet.pin_top();
    std::vector<Vec3> start;
    for (const Vec3& p : sheet.positions)
        start.emplace_back(p.x, 0.94f * p.y, 0.34f * p.y);  // by 20 degrees aside
    Cloth cloth(fabric(sheet.cook(cotton())), {}, start);
    const auto jobs = Jobs::own(0);
    cloth.come_to_lengths([&](float, std::vector<Vec3>& targets, std::vector<Collider>&) { targets = start; },
                          *jobs);
    for (int i = 0; i < 59; ++i) cloth.step(kFrame_s, start, {}, *jobs);
    const std::vector<Vec3> before = cloth.positions();
    cloth.step(kFrame_s, start, {}, *jobs);
    float most = 0.0f;
    for (size_t v = 0; v < before.size(); ++v)
        most = std::max(most, glm::length(cloth.positions()[v] - before[v]));
    EXPECT_LT(most, 0.001f);
    EXPECT_LT(std::abs(before.back().z), 0.02f) << "and straight down";
    EXPECT_EQ(cloth.stats().substeps, 8u) << "twice as many only until then";
}

TEST(ClothLengths, HasteIsWhatABudgetSparesFirst) {
    Hanging hanging;
    const auto settle = [&](float budget_ms) {
        hanging.cloth->set_quality(8, budget_ms);
        hanging.cloth->come_to_lengths(
            [&](float, std::vector<Vec3>& targets, std::vector<Collider>&) { targets = hanging.targets; },
            *hanging.jobs);
        hanging.step(2);
        return hanging.cloth->stats().substeps;
    };
    EXPECT_EQ(settle(0.0f), 16u) << "no budget";
    EXPECT_EQ(settle(1e4f), 16u);
    EXPECT_EQ(settle(1e-4f), 1u);
}

TEST(ClothBudget, APropMayGoFurtherInASubstepThanALimb) {
    ClothSettings settings;
    settings.sleeps = false;
    Hanging hanging(settings);
    const Sheet wall{20, 15, 0.02f};
    std::vector<Vec3> places = wall.positions;
    for (Vec3& p : places) p.z -= 0.1f;
    const uint32_t mesh = hanging.cloth->add_mesh(places.size(), wall.indices, {}, MeshOf::prop);
    const auto substeps = [&](float way_m) {
        for (size_t v = 0; v < places.size() / 2; ++v) places[v].x += way_m;
        hanging.cloth->move_mesh(mesh, places);
        hanging.step(1);
        return hanging.cloth->stats().substeps;
    };
    EXPECT_EQ(substeps(0.0f), 8u);
    EXPECT_EQ(substeps(0.03f), 8u) << "3.75 mm a sub-step";
    EXPECT_EQ(substeps(0.04f), 10u) << "4 mm";
}

TEST(ClothBudget, WhatMovesFastTakesMoreSubsteps) {
    ClothSettings settings;
    settings.sleeps = false;
    Hanging hanging(settings);
    const Sheet wall{20, 15, 0.02f};
    std::vector<Vec3> places = wall.positions;
    for (Vec3& p : places) p.z -= 0.1f;
    const uint32_t mesh = hanging.cloth->add_mesh(places.size(), wall.indices);
    const auto substeps = [&](const Vec3& upper_way, const Vec3& lower_way) {
        for (size_t v = 0; v < places.size(); ++v) places[v] += v < places.size() / 2 ? upper_way : lower_way;
        hanging.cloth->move_mesh(mesh, places);
        hanging.step(1);
        return hanging.cloth->stats().substeps;
    };
    EXPECT_EQ(substeps({}, {}), 8u);
    EXPECT_EQ(substeps({0.006f, 0, 0}, {}), 8u) << "0.75 mm a sub-step";
    EXPECT_EQ(substeps({0.02f, 0, 0}, {}), 20u) << "1 mm";
    EXPECT_EQ(substeps({0.01f, 0, 0}, {-0.01f, 0, 0}), 20u) << "1 mm, one part against the other";
    EXPECT_EQ(substeps({-0.05f, 0, 0}, {-0.05f, 0, 0}), 8u) << "the whole of it";
    EXPECT_EQ(substeps({0.3f, 0, 0}, {}), 64u) << "no more than eight times as many";
    hanging.cloth->set_quality(8, 1e-4f);
    EXPECT_EQ(substeps({-0.3f, 0, 0}, {}), 1u) << "nor than the budget allows";
}

TEST(ClothBudget, LessTimeIsFewerSubstepsAndNoMoreThanAsked) {
    ClothSettings settings;
    settings.sleeps = false;
    Hanging hanging(settings);
    hanging.step(5);
    EXPECT_EQ(hanging.cloth->stats().substeps, 8u);
    hanging.cloth->set_quality(8, 1e-4f);
    hanging.step(60);
    EXPECT_EQ(hanging.cloth->stats().substeps, 1u);
    EXPECT_LT(hanging.cloth->stats().strain_max, 0.2f);
    hanging.cloth->set_quality(4, 1e4f);
    hanging.step(1);
    EXPECT_EQ(hanging.cloth->stats().substeps, 4u);
    EXPECT_NE(test::error_of([&] { hanging.cloth->set_quality(0, 0.0f); }), "");
    EXPECT_NE(test::error_of([&] { hanging.cloth->set_quality(8, NAN); }), "");
}

/// Sheets of 10 cm squares that fall on balls of 3 cm.
struct OnABall {
    Sheet sheet{5, 5, 0.1f};
    std::vector<Vec3> start;
    std::vector<Collider> balls;
    static constexpr float kRadius = 0.03f, kThickness = 0.004f;

    OnABall() {
        for (const Vec3& p : sheet.positions) start.emplace_back(p.x, 0.1f, p.y);
        for (const Vec2 at : {Vec2(0.167f, -0.133f), Vec2(0.233f, -0.267f), Vec2(0.133f, -0.333f),
                              Vec2(0.067f, -0.067f), Vec2(0.333f, -0.167f)}) {
            balls.push_back(sphere({at.x, 0.0f, at.y}, kRadius));
        }
    }
    Cloth cloth(float virtual_m) const {
        ClothSettings settings;
        settings.virtual_m = virtual_m;
        settings.thickness_m = kThickness;
        settings.sleeps = false;
        return Cloth(fabric(sheet.cook(cotton())), settings, start);
    }
    /// The deepest that any point of a triangle is in a ball.
    float deepest(const std::vector<Vec3>& places) const {
        constexpr int kCuts = 20;
        float most = -1.0f;
        for (size_t t = 0; t + 2 < sheet.indices.size(); t += 3)
            for (int i = 0; i <= kCuts; ++i)
                for (int k = 0; i + k <= kCuts; ++k) {
                    const float a = float(i) / kCuts, b = float(k) / kCuts;
                    const Vec3 p = a * places[sheet.indices[t]] + b * places[sheet.indices[t + 1]] +
                                   (1.0f - a - b) * places[sheet.indices[t + 2]];
                    for (const Collider& ball : balls)
                        most = std::max(most, kRadius - glm::length(p - ball.center));
                }
        return most;
    }
};

TEST(VirtualParticles, CarryACoarseSheetThatItsVerticesLetFallThroughABall) {
    const OnABall scene;
    for (const uint32_t workers : {0u, 1u}) {
        const auto jobs = Jobs::own(workers);
        Cloth by_vertices = scene.cloth(0.0f), by_points = scene.cloth(0.02f);
        float through = 0.0f, deepest = 0.0f;
        uint64_t hash = 0;
        for (int frame = 0; frame < 60; ++frame) {
            by_vertices.step(kFrame_s, scene.start, scene.balls, *jobs);
            by_points.step(kFrame_s, scene.start, scene.balls, *jobs);
            through = std::max(through, scene.deepest(by_vertices.positions()));
            deepest = std::max(deepest, scene.deepest(by_points.positions()));
            hash = by_points.state_hash();
        }
        EXPECT_GT(through, 0.02f) << "the scene would show it";
        EXPECT_LT(deepest, 0.006f);
        static uint64_t first = hash;
        EXPECT_EQ(hash, first) << "the same on any number of threads";
    }
}

TEST(VirtualParticles, FineMeshesNeedNone) {
    const Fabric fine(Sheet(5, 5, 0.01f).cook(cotton())), coarse(Sheet(5, 5, 0.1f).cook(cotton()));
    EXPECT_EQ(VirtualParticles(fine, 0.01f).count(), 0u);
    // A square's diagonal is 141 mm: cut in 5.
    EXPECT_EQ(VirtualParticles(coarse, 0.02f).count(), 32u * 25u);
    FabricData pinned = Sheet(2, 2, 0.1f).cook(cotton());
    std::fill(pinned.inverse_mass.begin(), pinned.inverse_mass.end(), 0.0f);
    pinned.edges.clear(), pinned.bends.clear(), pinned.hinges.clear(), pinned.tethers.clear();
    EXPECT_EQ(VirtualParticles(Fabric(pinned), 0.02f).count(), 0u) << "what cannot move needs none";
}

TEST(VirtualParticles, AWayThatMakesNoSenseIsRefused) {
    const OnABall scene;
    EXPECT_EQ(error_of([&] { scene.cloth(-1.0f); }), "-2 the way between virtual particles is -1 m");
    EXPECT_EQ(error_of([&] { scene.cloth(1e-9f); }), "-2 the way between virtual particles is 1e-09 m");
}

}  // namespace
}  // namespace vfit
