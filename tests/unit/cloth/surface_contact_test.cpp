// Contact with meshes and of a cloth with itself: nearest points, cloth on a ball of triangles, layers that
// stay layers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bench/drape_scenes.h"
#include "cloth/base/triangle_fans.h"
#include "cloth/contact/surface_kernels.h"
#include "cloth/crossings.h"
#include "cloth_support.h"
#include "cloth_targets.h"
#include "support/allocation_count.h"  // counted by cloth_test.cpp

namespace vfit {
namespace {

using namespace test;

TEST(NearestOnTriangle, NoPlaceOfItIsNearer) {
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        const Vec3 a = random_point(random, 1), b = random_point(random, 1),
                   c = i % 10 ? random_point(random, 1) : a + 0.5f * (b - a);
        const Vec3 p = random_point(random, 2);
        const Vec3 w = nearest_on_triangle(p, a, b, c);
        EXPECT_NEAR(w.x + w.y + w.z, 1.0f, 1e-4f);
        EXPECT_GE(std::min({w.x, w.y, w.z}), 0.0f);
        const float distance = glm::length(p - (w.x * a + w.y * b + w.z * c));
        for (float u = 0; u <= 1.0f; u += 0.05f)
            for (float v = 0; u + v <= 1.0f; v += 0.05f)
                EXPECT_LE(distance, glm::length(p - ((1 - u - v) * a + u * b + v * c)) + 1e-4f);
    }
}

TEST(SurfaceKernels, NearestPlaceOnTheTrianglesAboutAPoint) {
    on_each_target([] {
        std::mt19937 random(4);
        constexpr uint32_t kPoints = 40;
        Particles all(kPoints), run(kLanes);
        for (Particle& p : all) p.x = random_point(random, 1.0f);
        std::vector<uint32_t> indices;
        for (int i = 0; i < 100; ++i) {  // the last has no triangle
            const uint32_t first = uint32_t(random() % (kPoints - 1)),
                           second = (first + 1 + uint32_t(random() % 10)) % (kPoints - 1);
            indices.insert(indices.end(),
                           {first, second, (second + 1 + uint32_t(random() % 10)) % (kPoints - 1)});
        }
        all[7].x = all[8].x;
        all[9].x = Vec3(NAN);
        const TriangleFans fans(kPoints, indices);
        for (int round = 0; round < 50; ++round) {
            for (Particle& p : run) p.x = random_point(random, 1.5f);
            uint32_t points[kLanes];
            for (uint32_t& point : points) point = uint32_t(random() % kPoints);
            points[3] = NearestOnFans::kNone;
            NearestOnFans found;
            find_nearest_on_fans(run.data(), points, fans, all.data(), found);
            for (size_t lane = 0; lane < kLanes; ++lane) {
                const Vec3 p = run[particle_at(lane)].x;
                float best2 = INFINITY;
                if (points[lane] != NearestOnFans::kNone)
                    for (const TriangleFans::Corners& c : fans.of(points[lane])) {
                        const Vec3 a = all[points[lane]].x, b = all[c.second].x, third = all[c.third].x;
                        const Vec3 w = nearest_on_triangle(p, a, b, third),
                                   off = p - (w.x * a + w.y * b + w.z * third);
                        if (const float distance2 = glm::dot(off, off); distance2 < best2) best2 = distance2;
                    }
                if (best2 == INFINITY) {
                    EXPECT_EQ(found.corners[lane], NearestOnFans::kNone);
                    continue;
                }
                ASSERT_NE(found.corners[lane], NearestOnFans::kNone);
                const TriangleFans::Corners& c = fans.corners()[found.corners[lane]];
                const Vec3 w = found.weights(lane);
                const Vec3 off =
                    p - (w.x * all[points[lane]].x + w.y * all[c.second].x + w.z * all[c.third].x);
                EXPECT_GE(std::min({w.x, w.y, w.z}), -1e-5f);
                EXPECT_NEAR(glm::length(off), std::sqrt(best2), 2e-4f);
                EXPECT_NEAR(found.distance2[lane], best2, 1e-3f * std::max(best2, 0.1f));
            }
        }
    });
}

TEST(SurfaceKernels, NearestPointOfRuns) {
    on_each_target([] {
        std::mt19937 random(3);
        Particles all(kLanes * 6);
        for (Particle& p : all) p.x = random_point(random, 0.1f);
        all[5 * kLanes + 3].x = Vec3(NAN);
        const float reach = 0.08f;
        NearestOfRun nearest(reach);
        const std::vector<uint32_t> runs{1, 2, 4, 5};
        find_nearest_in_runs(all.data(), all.data(), runs, nearest);
        for (size_t lane = 0; lane < kLanes; ++lane) {
            float best2 = reach * reach;
            uint32_t id = UINT32_MAX;
            for (const uint32_t run : runs)
                for (uint32_t at = run * uint32_t(kLanes); at < (run + 1) * kLanes; ++at) {
                    const Vec3 way = all[at].x - all[particle_at(lane)].x;
                    if (glm::dot(way, way) < best2) best2 = glm::dot(way, way), id = at;
                }
            EXPECT_EQ(nearest.id[lane], id) << lane;
        }
    });
}

TEST(SurfaceKernels, BoxesThatMeet) {
    on_each_target([] {
        std::mt19937 random(4);
        RunBoxes boxes;
        constexpr size_t kCount = 83;
        boxes.resize(kCount);
        for (size_t i = 0; i < kCount; ++i) {
            const Vec3 low = random_point(random, 1);
            boxes.runs.set(i, low, low + Vec3(0.3f));
        }
        boxes.find_blocks();
        std::vector<uint32_t> expected, found;
        const Vec3 low(-0.2f), high(0.4f);
        for (uint32_t i = 0; i < kCount; ++i)
            if (glm::all(glm::lessThanEqual(boxes.runs.low_of(i), high)) &&
                glm::all(glm::greaterThanEqual(boxes.runs.high_of(i), low)))
                expected.push_back(i);
        find_meeting(boxes, low, high, found);
        EXPECT_EQ(found, expected);
        EXPECT_GT(found.size(), 3u);
    });
}

/// A ball of triangles.
struct BallMesh {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;

    BallMesh(const Vec3& center, float radius, uint32_t rings = 32) {
        for (uint32_t r = 0; r <= rings; ++r)
            for (uint32_t c = 0; c < 2 * rings; ++c) {
                const float polar = kPi * float(r) / float(rings), round = kPi * float(c) / float(rings);
                positions.push_back(center + radius * Vec3(std::sin(polar) * std::cos(round), std::cos(polar),
                                                           std::sin(polar) * std::sin(round)));
            }
        for (uint32_t r = 0; r < rings; ++r)
            for (uint32_t c = 0; c < 2 * rings; ++c) {
                const uint32_t a = r * 2 * rings + c, b = r * 2 * rings + (c + 1) % (2 * rings),
                               d = a + 2 * rings, e = b + 2 * rings;
                if (r > 0) indices.insert(indices.end(), {a, b, d});
                if (r + 1 < rings) indices.insert(indices.end(), {b, e, d});
            }
    }
    void move(const Vec3& way) {
        for (Vec3& p : positions) p += way;
    }
};

/// A sheet that lies down.
std::vector<Vec3> lying(const Sheet& sheet, const Vec3& corner) {
    std::vector<Vec3> out;
    for (const Vec3& p : sheet.positions) out.push_back(corner + Vec3(p.x, 0, -p.y));
    return out;
}

TEST(MeshContact, AClothComesToRestOnABallOfTriangles) {
    const auto jobs = Jobs::own(0);
    const Sheet sheet(21, 21, 0.02f);
    const Vec3 center(0, 0, 0);
    BallMesh ball(center, 0.12f);
    ClothSettings settings;
    settings.friction = 0.8f;
    settings.thickness_m = 0.003f;
    Cloth cloth(fabric(sheet.cook(cotton())), settings, lying(sheet, {-0.2f, 0.14f, -0.2f}));
    const uint32_t mesh = cloth.add_mesh(ball.positions.size(), ball.indices);
    const std::vector<Vec3> targets = lying(sheet, {-0.2f, 0.14f, -0.2f});
    for (int frame = 0; frame < 180; ++frame) {
        cloth.move_mesh(mesh, ball.positions);
        cloth.step(kFrame_s, targets, {}, *jobs);
    }
    std::vector<float> gaps;
    for (const Vec3& p : cloth.positions()) {
        const float gap = glm::length(p - center) - 0.12f;
        EXPECT_GT(gap, 0.001f);  // the mesh's triangles lie up to 0.6 mm inside the ball
        if (gap < 0.01f) gaps.push_back(gap);
    }
    ASSERT_GT(gaps.size(), 100u) << "it lies on the ball";
    std::nth_element(gaps.begin(), gaps.begin() + std::ptrdiff_t(gaps.size() / 2), gaps.end());
    EXPECT_LT(gaps[gaps.size() / 2], 0.006f);
}

TEST(MeshContact, ABallThatIsThrownIntoACurtainTakesItAlong) {
    const auto jobs = Jobs::own(0);
    Sheet sheet(41, 41, 0.015f);
    sheet.pin_top();
    for (const float speed : {0.5f, 2.0f, 4.0f}) {
        BallMesh ball({0.3f, -0.3f, -0.2f}, 0.1f);
        Vec3 center(0.3f, -0.3f, -0.2f);
        Cloth cloth(fabric(sheet.cook(cotton())), {}, sheet.positions);
        const uint32_t mesh = cloth.add_mesh(ball.positions.size(), ball.indices);
        cloth.move_mesh(mesh, ball.positions);
        for (float way = 0.0f; way < 0.3f; way += speed * kFrame_s) {
            ball.move({0, 0, speed * kFrame_s});
            center.z += speed * kFrame_s;
            cloth.move_mesh(mesh, ball.positions);
            cloth.step(kFrame_s, sheet.positions, {}, *jobs);
        }
        float deepest = 0.0f;
        for (const Vec3& p : cloth.positions()) deepest = std::max(deepest, 0.1f - glm::length(p - center));
        EXPECT_LT(deepest, 0.002f) << speed;
        EXPECT_GT(cloth.positions()[sheet.at(20, 20)].z, center.z + 0.05f) << speed << ": before the ball";
    }
}

TEST(MeshContact, WhatDoesNotFitIsRefusedAndWhatIsNotFiniteIsLeftOut) {
    const auto jobs = Jobs::own(0);
    const Sheet sheet(5, 5, 0.02f);
    Cloth cloth(fabric(sheet.cook(cotton())), {}, sheet.positions);
    BallMesh ball({0.04f, -0.3f, 0}, 0.1f);
    EXPECT_NE(error_of([&] { cloth.add_mesh(10, ball.indices); }).find("of 10"), std::string::npos);
    EXPECT_NE(error_of([&] { cloth.add_mesh(ball.positions.size(), ball.indices, std::vector<uint8_t>(3)); }),
              "");
    const uint32_t mesh = cloth.add_mesh(ball.positions.size(), ball.indices);
    EXPECT_NE(error_of([&] { cloth.move_mesh(mesh + 1, ball.positions); }), "");
    EXPECT_NE(error_of([&] { cloth.move_mesh(mesh, sheet.positions); }), "");
    cloth.move_mesh(mesh, ball.positions);
    cloth.hide_mesh(mesh);
    EXPECT_NE(error_of([&] { cloth.hide_mesh(mesh + 1); }), "");
    cloth.step(kFrame_s, sheet.positions, {}, *jobs);
    for (size_t i = 0; i < ball.positions.size(); i += 3) ball.positions[i].x = NAN;
    for (int frame = 0; frame < 60; ++frame) {
        cloth.move_mesh(mesh, ball.positions);
        cloth.step(kFrame_s, sheet.positions, {}, *jobs);
    }
    for (const Vec3& p : cloth.positions()) EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
}

TEST(MeshContact, SkinIsNeverLetThroughATautStrip) {
    // A strip pinned at both ends, and a ball of 5 cm radius that comes up through it. A strip that stays in
    // front of the ball is at least as long as a taut line from pin to pin around it: two tangents and an
    // arc.
    constexpr float kRadius_m = 0.05f, kRise_m = 0.06f, kHalf_m = 0.06f;
    const float away = std::hypot(kRise_m, kHalf_m),
                wrapped = kPi - std::atan2(kHalf_m, kRise_m) - std::acos(kRadius_m / away);
    const float taut_m = 2.0f * (std::sqrt(away * away - kRadius_m * kRadius_m) + kRadius_m * wrapped);
    const auto jobs = Jobs::own(0);
    Sheet sheet(9, 9, 0.015f);
    sheet.pin_top();
    for (uint32_t c = 0; c < 9; ++c) sheet.simulated[sheet.at(8, c)] = 0;
    Cloth cloth(fabric(sheet.cook(cotton())), {}, sheet.positions);
    const Vec3 middle = sheet.positions[sheet.at(4, 4)];
    BallMesh ball(middle, kRadius_m);
    const uint32_t mesh = cloth.add_mesh(ball.positions.size(), ball.indices);
    float most_m = 0.0f;
    for (int frame = 0; frame < 240; ++frame) {
        const float z = std::min(0.0f, -0.1f + 0.001f * float(frame)) + kRise_m;
        cloth.move_mesh(mesh, BallMesh(middle + Vec3(0, 0, z), kRadius_m).positions);
        cloth.step(kFrame_s, sheet.positions, {}, *jobs);
        if (frame < 120) continue;  // the ball stands still since a third of a second
        float length_m = 0.0f;
        for (uint32_t r = 0; r + 1 < 9; ++r)
            length_m +=
                glm::distance(cloth.positions()[sheet.at(r, 4)], cloth.positions()[sheet.at(r + 1, 4)]);
        most_m = std::max(most_m, length_m);
    }
    EXPECT_GT(most_m, taut_m);
}

TEST(MeshContact, ClothThatIsDrawnIntoAHollowStaysOutOfBothSides) {
    // A groove along x, 40 degrees wide; into it hangs a strip, the end of which is drawn through one side
    // and the other in turn.
    const auto jobs = Jobs::own(0);
    std::vector<Vec3> groove;
    std::vector<uint32_t> indices;
    constexpr float kHalf_rad = 0.35f;
    const auto profile = [](float s) {
        return Vec3(0.0f, -0.1f + std::abs(s) * std::cos(kHalf_rad), s * std::sin(kHalf_rad));
    };
    constexpr uint32_t kAcross = 24, kAlong = 16;
    for (uint32_t r = 0; r <= kAlong; ++r)
        for (uint32_t c = 0; c <= kAcross; ++c)
            groove.push_back(profile(-0.12f + 0.01f * float(c)) + Vec3(0.02f * float(r) - 0.1f, 0, 0));
    for (uint32_t r = 0; r < kAlong; ++r)
        for (uint32_t c = 0; c < kAcross; ++c) {
            const uint32_t a = r * (kAcross + 1) + c, b = a + 1, d = a + kAcross + 1, e = d + 1;
            indices.insert(indices.end(), {a, b, e, a, e, d});
        }
    const auto deepest_with = [&](MeshOf what) {
        Sheet sheet(9, 9, 0.015f);
        sheet.pin_top();
        for (uint32_t c = 0; c < 9; ++c) sheet.simulated[sheet.at(8, c)] = 0;
        std::vector<Vec3> targets;
        for (const Vec3& p : sheet.positions) targets.emplace_back(p.x, p.y + 0.035f, 0.0f);
        ClothSettings settings;
        settings.sleeps = false;
        settings.friction = 0.0f;
        Cloth cloth(fabric(sheet.cook(cotton())), settings, targets);
        const uint32_t mesh = cloth.add_mesh(groove.size(), indices, {}, what);
        float deepest = 0.0f;
        for (int frame = 0; frame < 120; ++frame) {
            for (uint32_t c = 0; c < 9; ++c) targets[sheet.at(8, c)].z = frame / 4 % 2 ? 0.02f : -0.02f;
            cloth.move_mesh(mesh, groove);
            cloth.step(kFrame_s, targets, {}, *jobs);
            for (uint32_t r = 5; r < 8; ++r)
                for (uint32_t c = 0; c < 9 && frame > 30; ++c) {
                    const Vec3& p = cloth.positions()[sheet.at(r, c)];
                    if (p.y < -0.01f)
                        deepest = std::max(deepest, std::abs(p.z) * std::cos(kHalf_rad) -
                                                        (p.y + 0.1f) * std::sin(kHalf_rad));
                }
        }
        return deepest;
    };
    EXPECT_LT(deepest_with(MeshOf::solid), 0.001f);
}

/// A ball comes from below, with steps of 1/30 s: contacts are found in the middle of them as well.
TEST(MeshContact, ALongStepFindsContactsAsOftenAsTwoShortOnes) {
    const auto jobs = Jobs::own(0);
    Sheet sheet(11, 11, 0.02f);
    const std::vector<Vec3> start = lying(sheet, {});
    const auto after = [&](int steps) {
        BallMesh ball({0.1f, -0.06f, 0.1f}, 0.05f);
        Cloth cloth(fabric(sheet.cook(cotton())), {}, start);
        const uint32_t mesh = cloth.add_mesh(ball.positions.size(), ball.indices);
        cloth.move_mesh(mesh, ball.positions);
        cloth.step(kFrame_s, start, {}, *jobs);
        for (int i = 0; i < 4; ++i)
            for (int k = 0; k < steps; ++k) {
                ball.move(Vec3(0.0f, 0.02f, 0.0f) / float(steps));
                cloth.move_mesh(mesh, ball.positions);
                cloth.step(2.0f * kFrame_s / float(steps), start, {}, *jobs);
            }
        return cloth.positions();
    };
    const std::vector<Vec3> one = after(1), two = after(2);
    float most_m = 0.0f;
    for (size_t v = 0; v < one.size(); ++v) most_m = std::max(most_m, glm::distance(one[v], two[v]));
    EXPECT_LT(most_m, 1e-4f);
}

TEST(ColliderMotion, StandsStillOnceItHasArrived) {
    ColliderMotion motion;
    Collider ball;
    ball.radius = 0.1f;
    motion.accept(std::vector{ball}, 0.0f);
    motion.arrive();
    ball.center.x = 0.05f;
    motion.accept(std::vector{ball}, 0.0f);
    EXPECT_FLOAT_EQ(motion.greatest_way(), 0.05f);
    motion.look_at({0.5f, 1.0f});
    std::vector<SweptCapsule> swept;
    motion.sweep(0.0f, 1.0f, swept);
    ASSERT_EQ(swept.size(), 1u);
    EXPECT_FLOAT_EQ(swept[0].from.a.x, 0.025f);
    EXPECT_FLOAT_EQ(swept[0].to.a.x, 0.05f);
    motion.arrive();
    EXPECT_EQ(motion.greatest_way(), 0.0f) << "steps that follow without a new place go nowhere";
}

TEST(MeshContact, AFilterSaysWhichClothMeetsIt) {
    const auto jobs = Jobs::own(0);
    Sheet sheet(11, 11, 0.02f);
    const BallMesh ball({0.1f, -0.06f, 0.1f}, 0.05f);
    const std::vector<Vec3> start = lying(sheet, {});
    const std::vector<uint8_t> category(ball.positions.size(), 2);
    const auto lowest_after = [&](uint8_t mask) {
        Cloth cloth(fabric(sheet.cook(cotton())), {}, start);
        const std::vector<uint8_t> masks(start.size(), mask);
        const uint32_t mesh =
            cloth.add_mesh(ball.positions.size(), ball.indices, {}, MeshOf::solid, {category, masks});
        for (int frame = 0; frame < 20; ++frame) {
            cloth.move_mesh(mesh, ball.positions);
            cloth.step(kFrame_s, start, {}, *jobs);
        }
        return cloth.positions()[sheet.at(5, 5)].y;
    };
    EXPECT_GT(lowest_after(2), -0.05f);
    EXPECT_GT(lowest_after(3), -0.05f);
    EXPECT_LT(lowest_after(1), -0.2f) << "it falls through";
    Cloth cloth(fabric(sheet.cook(cotton())), {}, start);
    EXPECT_NE(error_of([&] {
                  cloth.add_mesh(ball.positions.size(), ball.indices, {}, MeshOf::solid,
                                 {category, category});
              }).find("masks for a cloth of 121"),
              std::string::npos);
}

TEST(MeshContact, AMeshThatWasHiddenDoesNotComeFromWhereItWas) {
    const auto jobs = Jobs::own(0);
    Sheet sheet(21, 21, 0.02f);
    sheet.pin_top();
    BallMesh ball({0.2f, -0.2f, 0.13f}, 0.1f);
    for (const int hidden : {1, 2}) {
        Cloth cloth(fabric(sheet.cook(cotton())), {}, sheet.positions);
        const uint32_t mesh = cloth.add_mesh(ball.positions.size(), ball.indices);
        const auto step = [&] { cloth.step(kFrame_s, sheet.positions, {}, *jobs); };
        cloth.move_mesh(mesh, ball.positions);
        step();
        cloth.hide_mesh(mesh);
        for (int i = 0; i < hidden; ++i) step();
        ball.move({0, 0, -0.26f});  // behind the curtain, which it could not pass
        cloth.move_mesh(mesh, ball.positions);
        for (int i = 0; i < 10; ++i) step();
        for (const Vec3& p : cloth.positions()) ASSERT_NEAR(p.z, 0.0f, 0.002f) << hidden;
        ball.move({0, 0, 0.26f});
    }
}

TEST(MeshContact, WhatTouchedAMeshThatIsElsewhereAtOnceStays) {
    const auto jobs = Jobs::own(0);
    Sheet sheet(21, 21, 0.02f);
    sheet.pin_top();
    for (const bool away : {false, true}) {
        BallMesh ball({0.2f, -0.2f, 0.107f}, 0.1f);
        Cloth cloth(fabric(sheet.cook(cotton())), {}, sheet.positions);
        cloth.meet_edges();
        const uint32_t mesh = cloth.add_mesh(ball.positions.size(), ball.indices, {}, MeshOf::prop);
        const auto step = [&] {
            cloth.move_mesh(mesh, ball.positions);
            cloth.step(kFrame_s, sheet.positions, {}, *jobs);
        };
        for (int i = 0; i < 10; ++i) step(), ball.move({0, 0, -0.005f});
        const Vec3 before = cloth.positions()[sheet.at(10, 10)];
        EXPECT_LT(before.z, -0.03f) << "they touch";
        if (away) cloth.hide_mesh(mesh);
        ball.move({away ? 5.0f : 0.0f, 0.04f, -0.04f});
        step();
        const float way_m = glm::distance(cloth.positions()[sheet.at(10, 10)], before);
        if (away)
            EXPECT_LT(way_m, 0.01f);
        else
            EXPECT_GT(way_m, 0.02f) << "the scene would show it";
    }
}

TEST(MeshContact, WhatHangsBelowAHemIsNotDrawnUpToIt) {
    const auto jobs = Jobs::own(0);
    Sheet curtain(21, 21, 0.02f);
    curtain.pin_top();
    // A curtain that is worn below, half as long, and 2 mm before the one that is to hang outside of it.
    Sheet inner(11, 21, 0.02f);
    for (Vec3& p : inner.positions) p += Vec3(0, -0.008f, 0.002f);
    Cloth cloth(fabric(curtain.cook(cotton())), {}, curtain.positions);
    const uint32_t mesh = cloth.add_mesh(inner.positions.size(), inner.indices);
    for (int frame = 0; frame < 60; ++frame) {
        cloth.move_mesh(mesh, inner.positions);
        cloth.step(kFrame_s, curtain.positions, {}, *jobs);
    }
    for (uint32_t c = 2; c < 19; ++c) {
        EXPECT_GT(cloth.positions()[curtain.at(5, c)].z, 0.002f)
            << "outside of it, where there is something to be outside of";
        for (const uint32_t r : {11u, 12u})
            EXPECT_NEAR(cloth.positions()[curtain.at(r, c)].y, curtain.positions[curtain.at(r, c)].y, 0.006f)
                << r;
    }
}

/// Three sheets, one above the other, fall on a ball.
struct ThreeLayers {
    FabricData data;
    std::vector<Vec3> start;
    size_t of_one;

    ThreeLayers() {
        const Sheet sheet(25, 25, 0.02f);
        of_one = sheet.positions.size();
        for (int layer = 0; layer < 3; ++layer) {
            const FabricData one = sheet.cook(cotton());
            const auto first = uint32_t(start.size());
            const std::vector<Vec3> places = lying(sheet, {-0.24f, 0.17f + 0.012f * float(layer), -0.24f});
            start.insert(start.end(), places.begin(), places.end());
            data.inverse_mass.insert(data.inverse_mass.end(), one.inverse_mass.begin(),
                                     one.inverse_mass.end());
            for (uint32_t i : one.indices) data.indices.push_back(first + i);
            for (DistanceConstraint e : one.edges)
                data.edges.push_back({first + e.a, first + e.b, e.rest_m, e.compliance_m_n});
            for (DistanceConstraint b : one.bends)
                data.bends.push_back({first + b.a, first + b.b, b.rest_m, b.compliance_m_n});
            for (Hinge h : one.hinges) {
                for (uint32_t& v : h.vertices) v += first;
                data.hinges.push_back(h);
            }
        }
    }
    Cloth cloth(float self_thickness_m) const {
        ClothSettings settings;
        settings.friction = 0.9f;
        settings.self_thickness_m = self_thickness_m;
        return Cloth(fabric(data), settings, start);
    }
};

TEST(SelfContact, LayersThatFallOnABallDoNotCross) {
    const auto jobs = Jobs::own(0);
    const ThreeLayers layers;
    const std::vector<Collider> ball{sphere({0, 0, 0}, 0.15f)};
    const auto crossed = [&](float thickness) {
        Cloth cloth = layers.cloth(thickness);
        size_t pairs = 0;
        for (int frame = 1; frame <= 90; ++frame) {
            cloth.step(kFrame_s, layers.start, ball, *jobs);
            pairs += crossed_triangles(cloth.positions(), layers.data.indices).size();
            EXPECT_EQ(cloth.stats().certified, thickness > 0.0f) << frame;
        }
        return pairs;
    };
    EXPECT_GT(crossed(0.0f), 1000u) << "the scene would show it";
    EXPECT_EQ(crossed(0.005f), 0u);
}

TEST(SelfContact, HalvesThatSwingAgainstEachOtherDoNotCross) {
    const auto jobs = Jobs::own(0);
    Sheet sheet(41, 21, 0.02f);  // held along its middle; its ends meet at 6 m/s
    for (uint32_t c = 0; c < sheet.columns; ++c) sheet.simulated[sheet.at(20, c)] = 0;
    const std::vector<Vec3> start = lying(sheet, Vec3(0.0f));
    const auto crossed = [&](float thickness) {
        ClothSettings settings;
        settings.self_thickness_m = thickness;
        Cloth cloth(fabric(sheet.cook(cotton())), settings, start);
        size_t pairs = 0;
        float fastest = 0.0f;
        std::vector<Vec3> before = start;
        for (int frame = 1; frame <= 60; ++frame) {
            cloth.step(kFrame_s, start, {}, *jobs);
            fastest = std::max(fastest, glm::length(cloth.positions()[10] - before[10]) / kFrame_s);
            before = cloth.positions();
            pairs += crossed_triangles(before, sheet.indices).size();
        }
        EXPECT_GT(fastest, 2.5f);
        return pairs;
    };
    EXPECT_GT(crossed(0.0f), 50u) << "the scene would show it";
    EXPECT_EQ(crossed(0.006f), 0u);
}

TEST(SelfContact, AFlatSheetDoesNotFeelItself) {
    const auto jobs = Jobs::own(0);
    const Sheet sheet(30, 30, 0.02f);
    std::vector<uint64_t> hashes;
    for (const float thickness : {0.0f, 0.008f}) {
        ClothSettings settings;
        settings.self_thickness_m = thickness;
        Cloth cloth(fabric(sheet.cook(cotton())), settings, lying(sheet, Vec3(0.0f)));
        for (int frame = 0; frame < 30; ++frame) cloth.step(kFrame_s, sheet.positions, {}, *jobs);
        hashes.push_back(cloth.state_hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(SelfContact, EqualBitsForAnyNumberOfWorkersAndNoAllocation) {
    const ThreeLayers layers;
    ASSERT_GT(fabric(layers.data)->layout().parts.size(), 1u);
    BallMesh ball({0, 0, 0}, 0.15f);
    std::vector<uint64_t> hashes;
    for (const uint32_t workers : {0u, 1u, 3u}) {
        const auto jobs = Jobs::own(workers);
        Cloth cloth = layers.cloth(0.005f);
        const uint32_t mesh = cloth.add_mesh(ball.positions.size(), ball.indices);
        uint64_t allocated = 0;
        for (int frame = 0; frame < 90; ++frame) {
            if (frame == 60) allocated = allocations;
            cloth.move_mesh(mesh, ball.positions);
            cloth.step(kFrame_s, layers.start, {}, *jobs);
        }
        EXPECT_LE(allocations - allocated, 6u) << "lists grow only where more meets than ever before";
        hashes.push_back(cloth.state_hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

}  // namespace
}  // namespace vfit
