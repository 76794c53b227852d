// Edges have a greatest length: by themselves, in the guard against crossings, and in a cloth.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cloth/contact/crossing_guard.h"
#include "cloth/contact/length_limit.h"
#include "cloth_support.h"
#include "two_sheets.h"

namespace vfit {
namespace {

using namespace test;

constexpr float kStep_m = 0.002f;

std::vector<Particle> particles_of(const std::vector<Vec3>& points) {
    std::vector<Particle> out;
    for (const Vec3& p : points) out.push_back(Particle{p});
    return out;
}

float greatest_strain(const std::vector<DistanceConstraint>& edges, const std::vector<Particle>& at) {
    float most = 0.0f;
    for (const DistanceConstraint& e : edges)
        most = std::max(most, glm::distance(at[e.a].x, at[e.b].x) / e.rest_m - 1.0f);
    return most;
}

FabricData with_edges(const TwoSheets& sheets) {
    FabricData data = sheets.fabric();
    for (size_t i = 0; i < sheets.indices.size(); ++i) {
        const uint32_t a = sheets.indices[i], b = sheets.indices[i % 3 == 2 ? i - 2 : i + 1];
        const float rest_m = glm::distance(sheets.positions[a], sheets.positions[b]);
        if (a < b) data.edges.push_back({a, b, rest_m, 0.0f});
    }
    return data;
}

/// A sheet of 2 cm squares, one vertex of which is pulled out of it.
struct Pulled {
    Sheet sheet{9, 9, 0.02f};
    FabricData data;
    std::vector<Particle> begin = particles_of(sheet.positions), end = begin;
    const uint32_t vertex = sheet.at(4, 4);

    explicit Pulled(float way_m, bool pinned = false) {
        if (pinned) sheet.simulated[vertex] = 0;
        data = sheet.cook(cotton());
        end[vertex].x.z += way_m;
    }
    float strain() const { return greatest_strain(data.edges, end); }
};

TEST(LengthLimit, EdgesThatAreTooLongComeBackToTheirLimit) {
    Pulled pulled(0.06f);
    ASSERT_GT(pulled.strain(), 1.0f);
    LengthLimit limit{Fabric(pulled.data)};
    limit.accept(pulled.begin);
    const auto moved = limit.keep(pulled.begin, pulled.end, kStep_m);
    EXPECT_LT(pulled.strain(), LengthLimit::kMaxStrain + 0.005f);
    std::vector<uint32_t> vertices(moved.begin(), moved.end());
    std::sort(vertices.begin(), vertices.end());
    EXPECT_EQ(std::adjacent_find(vertices.begin(), vertices.end()), vertices.end());
    Vec3 impulse(0.0f);
    for (uint32_t v = 0; v < pulled.end.size(); ++v) {
        const Vec3 wanted = pulled.begin[v].x + (v == pulled.vertex ? Vec3(0, 0, 0.06f) : Vec3(0.0f));
        EXPECT_EQ(pulled.end[v].x != wanted, std::binary_search(vertices.begin(), vertices.end(), v));
        impulse += (pulled.end[v].x - wanted) / pulled.data.inverse_mass[v];
    }
    EXPECT_LT(glm::length(impulse), 1e-7f) << "each end moves by its mass";
}

TEST(LengthLimit, WithinTheLimitNothingMoves) {
    Pulled pulled(0.012f);
    ASSERT_GT(pulled.strain(), 0.15f);
    const std::vector<Particle> before = pulled.end;
    LengthLimit limit{Fabric(pulled.data)};
    limit.accept(pulled.begin);
    EXPECT_TRUE(limit.keep(pulled.begin, pulled.end, kStep_m).empty());
    for (size_t v = 0; v < before.size(); ++v) EXPECT_EQ(pulled.end[v].x, before[v].x);
}

TEST(LengthLimit, WhatIsPinnedStaysAndTheRestFollows) {
    Pulled pulled(0.03f, true);
    const Vec3 at = pulled.end[pulled.vertex].x;
    LengthLimit limit{Fabric(pulled.data)};
    limit.accept(pulled.begin);
    limit.keep(pulled.begin, pulled.end, kStep_m);
    EXPECT_EQ(pulled.end[pulled.vertex].x, at);
    EXPECT_LT(pulled.strain(), LengthLimit::kMaxStrain + 0.01f);
}

TEST(LengthLimit, WhatWasTooLongBeforeGetsShorterByTheStep) {
    Pulled pulled(0.1f);
    pulled.begin = pulled.end;
    const DistanceConstraint& edge =
        *std::find_if(pulled.data.edges.begin(), pulled.data.edges.end(),
                      [&](const DistanceConstraint& e) { return e.a == pulled.vertex; });
    const auto length = [&] { return glm::distance(pulled.end[edge.a].x, pulled.end[edge.b].x); };
    const float before_m = length();
    LengthLimit limit{Fabric(pulled.data)};
    limit.keep(pulled.begin, pulled.end, kStep_m);
    EXPECT_NEAR(length(), before_m - kStep_m, 2e-4f);
}

TEST(LengthLimit, WhileItIsPutOnContactsLimitAloneHolds) {
    Pulled pulled(0.06f);
    LengthLimit limit{Fabric(pulled.data)};
    limit.keep(pulled.begin, pulled.end, kStep_m);
    EXPECT_LT(pulled.strain(), LengthLimit::kMaxContactStrain + 0.005f);
    EXPECT_GT(pulled.strain(), LengthLimit::kMaxContactStrain - 0.05f);
}

TEST(LengthLimit, WhatWasPutOnLongerStaysSoUntilItGetsShorter) {
    Pulled pulled(0.04f);
    LengthLimit limit{Fabric(pulled.data)};
    limit.accept(pulled.end);
    const float accepted = pulled.strain();
    ASSERT_GT(accepted, 0.5f);
    pulled.begin = pulled.end;
    EXPECT_TRUE(limit.keep(pulled.begin, pulled.end, kStep_m).empty());
    pulled.end[pulled.vertex].x.z += 0.01f;
    EXPECT_FALSE(limit.keep(pulled.begin, pulled.end, kStep_m).empty());
    EXPECT_NEAR(pulled.strain(), accepted, 0.01f);

    pulled.begin = particles_of(pulled.sheet.positions);
    pulled.end = pulled.begin;
    EXPECT_TRUE(limit.keep(pulled.begin, pulled.end, kStep_m).empty());
    pulled.end[pulled.vertex].x.z += 0.04f;
    limit.keep(pulled.begin, pulled.end, kStep_m);
    EXPECT_LT(pulled.strain(), LengthLimit::kMaxStrain + 0.005f);
}

TEST(LengthLimit, AfterContactChangesAreLookedAtAboutGivenVerticesAlone) {
    Pulled pulled(0.06f);
    LengthLimit limit{Fabric(pulled.data)};
    EXPECT_TRUE(
        limit.keep_about(std::vector{pulled.sheet.at(0, 0)}, {}, pulled.begin, pulled.end, kStep_m).empty());
    EXPECT_FALSE(limit.keep_about(std::vector{pulled.vertex}, {}, pulled.begin, pulled.end, kStep_m).empty());
    EXPECT_LT(pulled.strain(), LengthLimit::kMaxContactStrain + 0.005f);
    EXPECT_GT(pulled.strain(), LengthLimit::kMaxContactStrain - 0.05f) << "contact comes first";
}

TEST(LengthLimit, FlaggedVerticesStay) {
    Pulled pulled(0.06f);
    std::vector<uint8_t> stays(pulled.end.size(), 0);
    stays[pulled.vertex] = stays[pulled.sheet.at(4, 3)] = 1;
    const std::vector<Particle> before = pulled.end;
    LengthLimit limit{Fabric(pulled.data)};
    const auto moved = limit.keep_about(std::vector{pulled.vertex}, stays, pulled.begin, pulled.end, kStep_m);
    for (const uint32_t v : {pulled.vertex, pulled.sheet.at(4, 3)}) {
        EXPECT_EQ(pulled.end[v].x, before[v].x);
        EXPECT_EQ(std::count(moved.begin(), moved.end(), v), 0);
    }
    for (const DistanceConstraint& e : pulled.data.edges)
        if (!stays[e.a] || !stays[e.b]) {
            EXPECT_LT(glm::distance(pulled.end[e.a].x, pulled.end[e.b].x), 1.52f * e.rest_m);
        }
}

TEST(LengthLimit, WhatTheGuardMovesApartIsNotTorn) {
    const auto jobs = Jobs::own(0);
    std::mt19937 random(5);
    std::uniform_real_distribution<float> up_to(-0.0025f, 0.0025f);
    float with = 0.0f, without = 0.0f;
    for (int round = 0; round < 30; ++round) {
        const TwoSheets sheets(7, 0.005f, {0.0015f, 0.003f, 0.002f});
        const FabricData data = with_edges(sheets);
        std::vector<Particle> wanted = particles_of(sheets.positions);
        for (size_t v = 0; v < wanted.size(); ++v)
            wanted[v].x.y += (v < sheets.of_one ? 0.006f : -0.006f) + up_to(random);
        for (const bool limited : {false, true}) {
            const std::vector<Particle> begin = particles_of(sheets.positions);
            std::vector<Particle> end = wanted;
            CrossingGuard guard{Fabric(data)};
            Proximity proximity(sheets.positions, sheets.indices, 0.005f);
            EXPECT_TRUE(
                guard.keep(begin, end, proximity, *jobs, limited ? std::optional(kStep_m) : std::nullopt));
            TwoSheets now = sheets;
            for (size_t v = 0; v < end.size(); ++v) now.positions[v] = end[v].x;
            EXPECT_TRUE(now.crossed().empty()) << round;
            float& strain = limited ? with : without;
            strain = std::max(strain, greatest_strain(data.edges, end));
        }
    }
    EXPECT_GT(without, 0.6f) << "the scene would show it";
    EXPECT_LT(with, 0.55f);
}

TEST(LengthLimit, ZonesStayAsOneAndTheirNeighboursFollow) {
    const auto jobs = Jobs::own(0);
    std::mt19937 random(9);
    std::uniform_real_distribution<float> up_to(-0.004f, 0.004f);
    size_t with_zones = 0;
    for (int round = 0; round < 40; ++round) {
        // Whole sheets pass each other.
        const TwoSheets sheets(7, 0.01f, {0.003f, 0.003f, 0.004f});
        const FabricData data = with_edges(sheets);
        const std::vector<Particle> begin = particles_of(sheets.positions);
        std::vector<Particle> end = begin;
        for (size_t v = 0; v < end.size(); ++v)
            end[v].x +=
                Vec3(up_to(random), (v < sheets.of_one ? 0.05f : -0.05f) + up_to(random), up_to(random));
        CrossingGuard guard{Fabric(data)};
        Proximity proximity(sheets.positions, sheets.indices, 0.005f);
        EXPECT_TRUE(guard.keep(begin, end, proximity, *jobs, kStep_m)) << round;
        for (const uint32_t v : guard.moved()) with_zones += guard.is_in_zone(v) ? 1 : 0;
        for (const DistanceConstraint& e : data.edges) {
            const float strain = glm::distance(end[e.a].x, end[e.b].x) / e.rest_m - 1.0f;
            EXPECT_LT(strain, 0.55f);
            if (guard.is_in_zone(e.a) && guard.is_in_zone(e.b)) {
                EXPECT_NEAR(strain, 0.0f, 1e-3f) << "a zone is rigid";
            }
        }
    }
    EXPECT_GT(with_zones, 100u) << "the scene would show it";
}

/// A sheet in a frame of 28 cm.
struct Framed {
    Sheet sheet{15, 15, 0.02f};
    ClothSettings settings;

    explicit Framed(float self_thickness_m) {
        for (uint32_t i = 0; i < 15; ++i)
            for (const uint32_t v : {sheet.at(0, i), sheet.at(14, i), sheet.at(i, 0), sheet.at(i, 14)})
                sheet.simulated[v] = 0;
        settings.self_thickness_m = self_thickness_m;
    }
    Cloth cloth() const { return {fabric(sheet.cook(cotton())), settings, sheet.positions}; }
    static Collider ball(float z) { return sphere({0.14f, -0.14f, z}, 0.08f); }
};

TEST(LengthLimit, AClothGivesWayToABodyThatLeavesItNoRoom) {
    const auto jobs = Jobs::own(0);
    const auto strain_of = [&](float self_thickness_m) {
        const Framed framed(self_thickness_m);
        Cloth cloth = framed.cloth();
        float strain = 0.0f;
        for (int i = 0; i <= 60; ++i) {
            const std::vector<Collider> ball{Framed::ball(-0.1f + 0.01f * float(i))};
            cloth.step(kFrame_s, framed.sheet.positions, ball, *jobs);
            strain = std::max(strain, cloth.stats().strain_max);
        }
        return strain;
    };
    EXPECT_GT(strain_of(0.0f), 1.0f) << "the scene would show it";
    const float limited = strain_of(0.004f);
    EXPECT_LT(limited, 0.25f);
}

TEST(LengthLimit, ABodyIsNotPassedThroughWhileAClothIsPutOn) {
    const auto jobs = Jobs::own(0);
    const Framed framed(0.004f);
    Cloth cloth = framed.cloth();
    constexpr float kFrom_m = -0.1f, kTo_m = 0.04f;
    cloth.put_on(
        framed.sheet.positions,
        [&](float share, std::vector<Vec3>& targets, std::vector<Collider>& colliders) {
            targets = framed.sheet.positions;
            colliders = {Framed::ball(glm::mix(kFrom_m, kTo_m, share))};
        },
        *jobs);
    EXPECT_GT(cloth.stats().strain_max, 0.6f) << "the scene would show it";
    EXPECT_GT(cloth.positions()[framed.sheet.at(7, 7)].z, kTo_m + 0.06f) << "it lies in front of the ball";
}

}  // namespace
}  // namespace vfit
