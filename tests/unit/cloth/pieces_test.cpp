// Cloth of several pieces: each moves as it does alone, and they meet each other as layers of one cloth do.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "cloth/crossings.h"
#include "unit/cloth/cloth_support.h"
#include "unit/cloth/two_sheets.h"

namespace vfit {
namespace {

using namespace test;

using Fabrics = std::vector<std::shared_ptr<const Fabric>>;

std::vector<Vec3> both(const std::vector<Vec3>& first, const std::vector<Vec3>& second) {
    std::vector<Vec3> out = first;
    out.insert(out.end(), second.begin(), second.end());
    return out;
}

std::vector<Vec3> moved(std::vector<Vec3> places, const Vec3& by) {
    for (Vec3& p : places) p += by;
    return places;
}

std::vector<Vec3> of_piece(const Cloth& cloth, size_t piece) {
    const auto places = cloth.fabric().pieces()[piece].vertices.of(cloth.positions());
    return {places.begin(), places.end()};
}

/// A sheet that lies in a plane y = height, its normals up.
struct Lying {
    Sheet sheet;
    std::vector<Vec3> places;

    Lying(uint32_t side, float step_m, const Vec3& corner) : sheet(side, side, step_m) {
        for (const Vec3& p : sheet.positions) places.push_back(corner + Vec3(p.x, 0.0f, -p.y));
        for (size_t i = 0; i + 2 < sheet.indices.size(); i += 3) {
            uint32_t* t = &sheet.indices[i];
            if (glm::cross(places[t[1]] - places[t[0]], places[t[2]] - places[t[0]]).y < 0.0f)
                std::swap(t[1], t[2]);
        }
    }
};

size_t crossed(const Cloth& cloth, const Sheet& first, const Sheet& second) {
    return crossed_triangles({of_piece(cloth, 0), first.indices}, {of_piece(cloth, 1), second.indices})
        .size();
}

TEST(ClothPieces, ApartEachMovesAsItDoesAlone) {
    const auto jobs = Jobs::own(1);
    Sheet curtain(33, 33, 0.01f), flag(17, 25, 0.015f);
    curtain.pin_top(), flag.pin_top();
    const std::vector<Vec3> far_off = moved(flag.positions, {2.0f, 0.0f, 0.0f});
    const Fabrics fabrics{fabric(curtain.cook(cotton())), fabric(flag.cook(cotton()))};
    ClothSettings settings[2];
    settings[0].self_thickness_m = settings[1].self_thickness_m = 0.004f;
    settings[0].friction = 0.1f, settings[1].friction = 0.8f;
    // A ball that each rubs against.
    const Collider first_ball = sphere({0.16f, -0.2f, 0.06f}, 0.05f),
                   second_ball = sphere({2.18f, -0.12f, 0.06f}, 0.05f),
                   across_the_first = sphere({0.1f, -0.25f, 0.02f}, 0.05f);  // which meets the second alone
    Cloth first(fabrics[0], settings[0], curtain.positions), second(fabrics[1], settings[1], far_off),
        whole = Cloth::of_pieces(std::make_shared<const Fabric>(fabrics), settings,
                                 both(curtain.positions, far_off));
    const uint32_t ends[] = {1, 3};
    whole.set_collider_ends(ends);
    for (int frame = 0; frame < 40; ++frame) {
        const Vec3 way(0.0f, 0.0f, -0.003f * float(frame));
        Collider balls[] = {first_ball, second_ball, across_the_first};
        for (Collider& ball : balls) ball.center += way;
        first.step(kFrame_s, curtain.positions, std::span(balls).first(1), *jobs);
        second.step(kFrame_s, far_off, std::span(balls).last(2), *jobs);
        whole.step(kFrame_s, both(curtain.positions, far_off), balls, *jobs);
    }
    EXPECT_EQ(of_piece(whole, 0), first.positions());
    EXPECT_EQ(of_piece(whole, 1), second.positions());
    EXPECT_EQ(whole.state_hash(0), first.state_hash());
    EXPECT_EQ(whole.state_hash(1), second.state_hash());
    for (const size_t piece : {0u, 1u}) {
        const Cloth& alone = piece == 0 ? first : second;
        EXPECT_EQ(whole.stats(piece).vertex_count, alone.stats().vertex_count);
        EXPECT_EQ(whole.stats(piece).simulated_count, alone.stats().simulated_count);
        EXPECT_EQ(whole.stats(piece).constraint_count, alone.stats().constraint_count);
        EXPECT_EQ(whole.stats(piece).strain_max, alone.stats().strain_max);
    }
    EXPECT_GT(first.stats().strain_max, 0.001f) << "the ball touches it";
}

TEST(ClothPieces, BackstopsAndLimitsKeepTheirTargets) {
    const auto jobs = Jobs::own(0);
    Sheet sheet(9, 9, 0.02f);
    sheet.pin_top();
    FabricData data = sheet.cook(cotton());
    data.backstops.push_back({sheet.at(6, 4), 0.03f});
    data.limits.push_back({sheet.at(8, 0), 0.01f});
    data.limits.push_back({sheet.at(7, 0), 0.02f, sheet.at(8, 1)});
    const Fabrics fabrics{fabric(data), fabric(data)};
    const std::vector<Vec3> aside = moved(sheet.positions, {0.0f, 1.0f, 2.0f});
    const auto target = [&](const std::vector<Vec3>& places) {
        return both(places, {places[sheet.at(6, 4)] + Vec3(0.0f, 0.0f, -0.01f)});
    };
    ClothSettings settings[2];
    for (ClothSettings& of : settings) of.limits_lengths = false;  // alone, it has no layers that meet
    Cloth alone(fabrics[1], settings[1], aside),
        whole =
            Cloth::of_pieces(std::make_shared<const Fabric>(fabrics), settings, both(sheet.positions, aside));
    const std::vector<Vec3> first = target(sheet.positions), second = target(aside);
    const std::vector<Vec3> all = both(both(sheet.positions, aside), {first.back(), second.back()});
    for (int frame = 0; frame < 30; ++frame) {
        alone.step(kFrame_s, second, {}, *jobs);
        whole.step(kFrame_s, all, {}, *jobs);
    }
    EXPECT_EQ(of_piece(whole, 1), alone.positions());
    EXPECT_NE(alone.positions()[sheet.at(6, 4)].z, 2.0f) << "it is pushed";
    EXPECT_LT(glm::distance(alone.positions()[sheet.at(7, 0)], aside[sheet.at(8, 1)]), 0.022f)
        << "it is drawn";
}

/// The lower one hangs by its border, the upper one falls onto it.
struct TwoFall {
    Lying lower{13, 0.02f, {0.0f, 0.0f, 0.0f}}, upper{9, 0.02f, {0.04f, 0.03f, 0.04f}};
    std::unique_ptr<Jobs> jobs = Jobs::own(0);

    Cloth cloth(float upper_density, float own_m) {
        for (uint32_t i = 0; i < 13; ++i)
            for (const uint32_t v :
                 {lower.sheet.at(0, i), lower.sheet.at(12, i), lower.sheet.at(i, 0), lower.sheet.at(i, 12)})
                lower.sheet.simulated[v] = 0;
        FabricMaterial heavy = cotton();
        heavy.density_kg_m2 = upper_density;
        const Fabrics fabrics{fabric(lower.sheet.cook(cotton())), fabric(upper.sheet.cook(heavy))};
        ClothSettings settings[2];
        for (ClothSettings& of : settings) of.self_thickness_m = own_m, of.damping = 0.9f;
        return Cloth::of_pieces(std::make_shared<const Fabric>(fabrics), settings, start());
    }
    std::vector<Vec3> start() const { return both(lower.places, upper.places); }
    float sags_m(Cloth& cloth) {
        for (int frame = 0; frame < 90; ++frame) {
            cloth.step(kFrame_s, start(), {}, *jobs);
            EXPECT_EQ(crossed(cloth, lower.sheet, upper.sheet), 0u) << frame;
        }
        return -of_piece(cloth, 0)[lower.sheet.at(6, 6)].y;
    }
};

TEST(ClothPieces, TheyMeetAndTheHeavierOneMovesTheOther) {
    for (const float own_m : {0.004f, 0.0f}) {
        TwoFall light, heavy;
        Cloth under_light = light.cloth(0.05f, own_m), under_heavy = heavy.cloth(2.0f, own_m);
        const float little_m = light.sags_m(under_light), much_m = heavy.sags_m(under_heavy);
        EXPECT_GT(much_m, 1.5f * little_m) << own_m;
        for (const Vec3& p : of_piece(under_heavy, 1)) EXPECT_GT(p.y, -0.2f) << "it lies there";
    }
}

TEST(ClothPieces, WithoutAThicknessOfItsOwnAPiecePassesThroughItselfAlone) {
    // The lower piece is two sheets, one above the other; the upper one of these falls through the other.
    const auto jobs = Jobs::own(0);
    const Lying low(9, 0.02f, Vec3(0.0f)), high(9, 0.02f, {0.0f, 0.01f, 0.0f}),
        other(9, 0.02f, {0.0f, 0.03f, 0.0f});
    FabricData two = low.sheet.cook(cotton());
    const FabricData second = high.sheet.cook(cotton());
    const auto first = uint32_t(two.inverse_mass.size());
    for (const float m : second.inverse_mass) two.inverse_mass.push_back(m);
    for (float& m : std::span(two.inverse_mass).first(first)) m = 0.0f;
    for (const uint32_t v : second.indices) two.indices.push_back(first + v);
    for (const DistanceConstraint& e : second.edges)
        two.edges.push_back({first + e.a, first + e.b, e.rest_m, e.compliance_m_n});
    const Fabrics fabrics{fabric(two), fabric(other.sheet.cook(cotton()))};
    const ClothSettings settings[2];
    const std::vector<Vec3> start = both(both(low.places, high.places), other.places);
    Cloth cloth = Cloth::of_pieces(std::make_shared<const Fabric>(fabrics), settings, start);
    for (int frame = 0; frame < 30; ++frame) cloth.step(kFrame_s, start, {}, *jobs);
    EXPECT_LT(cloth.positions()[first + high.sheet.at(4, 4)].y, -0.05f);
    EXPECT_GT(of_piece(cloth, 1)[other.sheet.at(4, 4)].y, 0.0f) << "the other piece lies on the pinned one";
    EXPECT_FALSE(cloth.stats().certified) << "not of all layers";
}

TEST(ClothPieces, WhereOneComesThroughTheLaterOneGoesOutwards) {
    const auto jobs = Jobs::own(0);
    // The lower one is pinned, with a fold that goes through what lies on it.
    Lying lower(13, 0.02f, Vec3(0.0f)), upper(9, 0.02f, {0.04f, 0.004f, 0.04f});
    for (uint32_t c = 0; c < 13; ++c) lower.places[lower.sheet.at(6, c)].y = 0.012f;
    std::fill(lower.sheet.simulated.begin(), lower.sheet.simulated.end(), uint8_t(0));
    const Fabrics fabrics{fabric(lower.sheet.cook(cotton())), fabric(upper.sheet.cook(cotton()))};
    ClothSettings settings[2];
    for (ClothSettings& of : settings) of.self_thickness_m = 0.004f;
    const std::vector<Vec3> start = both(lower.places, upper.places);
    Cloth cloth = Cloth::of_pieces(std::make_shared<const Fabric>(fabrics), settings, start);
    ASSERT_GT(crossed(cloth, lower.sheet, upper.sheet), 0u);
    for (int frame = 0; frame < 60; ++frame) cloth.step(kFrame_s, start, {}, *jobs);
    EXPECT_EQ(crossed(cloth, lower.sheet, upper.sheet), 0u);
    EXPECT_TRUE(cloth.stats().certified);
    for (const Vec3& p : of_piece(cloth, 1))
        if (std::abs(p.z - 0.12f) < 0.01f) {
            EXPECT_GT(p.y, 0.012f);
        }
}

TEST(ClothPieces, TheyGoToOtherPlacesThroughEachOther) {
    const auto jobs = Jobs::own(0);
    const Lying lower(7, 0.02f, Vec3(0.0f)), upper(7, 0.02f, {0.0f, 0.01f, 0.0f});
    const Fabrics fabrics{fabric(lower.sheet.cook(cotton())), fabric(upper.sheet.cook(cotton()))};
    ClothSettings settings[2];
    for (ClothSettings& of : settings) of.self_thickness_m = 0.004f;
    Cloth cloth =
        Cloth::of_pieces(std::make_shared<const Fabric>(fabrics), settings, both(lower.places, upper.places));
    const std::vector<Vec3> wanted = both(lower.places, moved(lower.places, {0.0f, -0.01f, 0.0f}));
    cloth.go_to(wanted, *jobs);
    for (size_t v = 0; v < wanted.size(); ++v)
        EXPECT_LT(glm::distance(cloth.positions()[v], wanted[v]), 1e-5f);
    // From then on they meet again.
    for (int frame = 0; frame < 10; ++frame) cloth.step(kFrame_s, wanted, {}, *jobs);
    EXPECT_EQ(crossed(cloth, lower.sheet, upper.sheet), 0u);
}

TEST(ClothPieces, WhereAPieceCrossesItselfItIsMovedApartBeforeItGoes) {
    const auto jobs = Jobs::own(0);
    TwoSheets tangled(8, 0.02f, {0.004f, 0.004f, 0.005f});
    for (const uint32_t v : {27u, 28u, 35u, 36u})
        tangled.positions[tangled.of_one + v].y -= 0.012f;  // a bulge of the upper one, through the lower
    const Lying other(7, 0.02f, {0.0f, 0.02f, 0.0f});
    ASSERT_GT(tangled.crossed().size(), 0u);
    const Fabrics fabrics{fabric(tangled.fabric()), fabric(other.sheet.cook(cotton()))};
    ClothSettings settings[2];
    for (ClothSettings& of : settings) of.self_thickness_m = 0.004f;
    Cloth cloth = Cloth::of_pieces(std::make_shared<const Fabric>(fabrics), settings,
                                   both(tangled.positions, other.places));
    cloth.go_to(both(tangled.positions, moved(other.places, {0.0f, 0.01f, 0.0f})), *jobs);
    tangled.positions = of_piece(cloth, 0);
    EXPECT_EQ(tangled.crossed().size(), 0u);
}

TEST(ClothPieces, VelocitiesAreKept) {
    const auto jobs = Jobs::own(0);
    const Sheet sheet(5, 5, 0.02f);
    const auto one = fabric(sheet.cook(cotton()));
    Cloth falls(one, {}, sheet.positions), goes_on(one, {}, sheet.positions);
    for (int frame = 0; frame < 10; ++frame) falls.step(kFrame_s, sheet.positions, {}, *jobs);
    goes_on.reset(falls.positions());
    goes_on.set_velocities(falls.velocities());
    for (Cloth* cloth : {&falls, &goes_on}) cloth->step(kFrame_s, sheet.positions, {}, *jobs);
    for (size_t v = 0; v < sheet.positions.size(); ++v)
        EXPECT_LT(glm::distance(falls.positions()[v], goes_on.positions()[v]), 1e-5f);
    EXPECT_LT(goes_on.velocities()[0].y, -1.0f);
}

TEST(ClothPieces, WrongCountsAreRefused) {
    const Sheet sheet(3, 3, 0.02f);
    const auto one = fabric(sheet.cook(cotton()));
    const ClothSettings settings[2];
    EXPECT_NE(error_of([&] { Cloth::of_pieces(one, settings, sheet.positions); }), "");
    EXPECT_NE(error_of([] { Fabric{Fabrics{}}; }), "");
    EXPECT_NE(error_of([&] { Fabric{Fabrics(Fabric::kMaxPieces + 1, one)}; }), "");
    Cloth cloth(one, {}, sheet.positions);
    const uint32_t ends[] = {0, 0};
    EXPECT_NE(error_of([&] { cloth.set_collider_ends(ends); }), "");
    const std::vector<Vec3> few(3);
    EXPECT_NE(error_of([&] { cloth.set_velocities(few); }), "");
}

}  // namespace
}  // namespace vfit
