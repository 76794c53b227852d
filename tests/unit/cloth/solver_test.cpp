// The solver against mechanics: free fall, momentum, stretch under a weight, tethers, frame rate.
#include <gtest/gtest.h>

#include <cmath>

#include "cloth_support.h"

namespace vfit {
namespace {

using namespace test;

ClothSettings undamped() {
    ClothSettings s;
    s.damping = 0.0f;
    return s;
}

TEST(ClothSolver, FreeFallIsExact) {
    const auto jobs = Jobs::own(0);
    const std::vector<Vec3> start{{0, 10, 0}};
    Cloth cloth(lone_vertex(), undamped(), start);
    for (int frame = 0; frame < 60; ++frame) cloth.step(kFrame_s, start, {}, *jobs);
    EXPECT_NEAR(cloth.positions()[0].y, 10.0f - 0.5f * 9.81f, 2e-4f);
}

TEST(ClothSolver, FreeFallDoesNotDependOnStepOrSubsteps) {
    const auto jobs = Jobs::own(0);
    const std::vector<Vec3> start{{0, 10, 0}};
    for (const uint32_t substeps : {1u, 3u, 20u}) {
        ClothSettings settings = undamped();
        settings.substeps = substeps;
        Cloth cloth(lone_vertex(), settings, start);
        for (int frame = 0; frame < 20; ++frame) cloth.step(0.05f, start, {}, *jobs);
        EXPECT_NEAR(cloth.positions()[0].y, 10.0f - 0.5f * 9.81f, 2e-4f) << substeps << " sub-steps";
    }
}

TEST(ClothSolver, DampingTakesItsShareOfSpeedInASecond) {
    const auto jobs = Jobs::own(0);
    const std::vector<Vec3> start{{0, 0, 0}};
    ClothSettings settings;
    settings.damping = 0.75f;
    settings.gravity = Vec3(0, -1, 0);
    Cloth cloth(lone_vertex(), settings, start);
    for (int frame = 0; frame < 20 * 60; ++frame) cloth.step(kFrame_s, start, {}, *jobs);
    const float before = cloth.positions()[0].y;
    for (int frame = 0; frame < 60; ++frame) cloth.step(kFrame_s, start, {}, *jobs);
    // Terminal speed of v' = g - c v with exp(-c) = 1 - 0.75.
    EXPECT_NEAR(before - cloth.positions()[0].y, 1.0f / std::log(4.0f), 0.01f);
}

TEST(ClothSolver, ConstraintsKeepTheCentreOfMassWhereItIs) {
    const auto jobs = Jobs::own(0);
    const Sheet sheet(8, 8, 0.02f);
    ClothSettings settings = undamped();
    settings.gravity = Vec3(0.0f);
    std::vector<Vec3> start = sheet.positions;
    for (size_t i = 0; i < start.size(); ++i)  // crumpled: every constraint is violated
        start[i] +=
            0.004f * Vec3(std::sin(7.0f * float(i)), std::cos(5.0f * float(i)), std::sin(3.0f * float(i)));
    const auto data = fabric(sheet.cook(cotton()));
    const auto center = [&](const std::vector<Vec3>& x) {
        glm::dvec3 sum(0.0);
        double mass = 0.0;
        for (size_t i = 0; i < x.size(); ++i) {
            const double m = 1.0 / double(data->data().inverse_mass[i]);
            sum += glm::dvec3(x[i]) * m;
            mass += m;
        }
        return sum / mass;
    };
    Cloth cloth(data, settings, start);
    // Not longer: speeds are rounded, which alone takes it by 10 um in a second.
    for (int frame = 0; frame < 20; ++frame) cloth.step(kFrame_s, start, {}, *jobs);
    EXPECT_LT(glm::length(center(cloth.positions()) - center(start)), 1e-5);
    EXPECT_GT(glm::length(cloth.positions()[0] - start[0]), 1e-4f);  // it did move
}

/// By how much more than its modulus says.
float stretches_too_far(FabricMaterial material) {
    const auto jobs = Jobs::own(0);
    Sheet strip(17, 6, 0.02f);
    strip.pin_top();
    material.density_kg_m2 = 4.0f;  // heavy: a pass carries the load where compliance / h^2 outweighs 1 / m
    material.bend_n_m = 1e-6f;      // bends are springs too and would share the load
    FabricData data = strip.cook(material);
    data.tethers.clear();
    const float load_kg = material.stretch_warp_n_m / 3000.0f, width = 0.1f, length = 0.32f;
    for (uint32_t c = 0; c < strip.columns; ++c) {
        const float share = c == 0 || c + 1 == strip.columns ? 0.5f : 1.0f;
        float& w = data.inverse_mass[strip.at(strip.rows - 1, c)];
        w = 1.0f / (1.0f / w + load_kg * share / float(strip.columns - 1));
    }
    ClothSettings settings;
    settings.damping = 0.95f;
    settings.substeps = 64;
    Cloth cloth(fabric(std::move(data)), settings, strip.positions);
    for (int frame = 0; frame < 200; ++frame) cloth.step(kFrame_s, strip.positions, {}, *jobs);
    float lowest = 0.0f;
    for (uint32_t c = 0; c < strip.columns; ++c)
        lowest += cloth.positions()[strip.at(strip.rows - 1, c)].y / float(strip.columns);
    // The strip carries the load and, on average, half of itself.
    const float force = 9.81f * (load_kg + 0.5f * material.density_kg_m2 * width * length);
    const float expected = length * force / (material.stretch_warp_n_m * width);
    return (-lowest - length) / expected - 1.0f;
}

TEST(ClothSolver, StripStretchesAsItsModulusSays) {
    FabricMaterial material = cotton();
    material.stretch_warp_n_m = 300.0f;
    EXPECT_NEAR(stretches_too_far(material), 0.0f, 0.1f);
    // Leather: diagonals that shear as it does would take the load off warp and weft, but for their
    // narrowing.
    material.stretch_warp_n_m = 1000.0f, material.stretch_weft_n_m = 800.0f, material.shear_n_m = 300.0f;
    EXPECT_NEAR(stretches_too_far(material), 0.0f, 0.1f);
    // Shears more stiffly than springs that stretch so can.
    material.shear_n_m = 1000.0f;
    EXPECT_NEAR(stretches_too_far(material), 0.0f, 0.1f);
}

TEST(ClothSolver, StretchHardlyDependsOnSubsteps) {
    const auto jobs = Jobs::own(0);
    FabricData data;  // one spring of 20 N/m with 50 g
    data.inverse_mass = {0.0f, 20.0f};
    data.edges = {{0, 1, 0.5f, 0.05f}};
    const auto spring = fabric(std::move(data));
    const std::vector<Vec3> start{{0, 0, 0}, {0, -0.5f, 0}};
    for (const uint32_t substeps : {4u, 32u}) {
        ClothSettings settings;
        settings.substeps = substeps;
        settings.damping = 0.99f;
        Cloth cloth(spring, settings, start);
        for (int frame = 0; frame < 600; ++frame) cloth.step(kFrame_s, start, {}, *jobs);
        EXPECT_NEAR(-cloth.positions()[1].y - 0.5f, 0.05f * 9.81f / 20.0f, 1e-3f) << substeps << " sub-steps";
    }
}

TEST(ClothSolver, TetherHoldsWhatItsEdgesDoNot) {
    const auto jobs = Jobs::own(0);
    FabricData data;
    data.inverse_mass = {0.0f, 10.0f, 10.0f};
    data.edges = {{0, 1, 0.2f, 10.0f}, {1, 2, 0.2f, 10.0f}};  // 0.1 N/m: as good as nothing
    data.tethers = cook_tethers(data.inverse_mass, data.edges);
    ASSERT_EQ(data.tethers.size(), 2u);
    EXPECT_FLOAT_EQ(data.tethers[1].length_m, 0.4f);
    const std::vector<Vec3> start{{0, 0, 0}, {0.2f, 0, 0}, {0.4f, 0, 0}};
    Cloth cloth(fabric(std::move(data)), undamped(), start);
    for (int frame = 0; frame < 300; ++frame) {
        cloth.step(kFrame_s, start, {}, *jobs);
        ASSERT_LE(glm::length(cloth.positions()[1]), 0.2f * 1.00001f);
        ASSERT_LE(glm::length(cloth.positions()[2]), 0.4f * 1.00001f);
    }
}

TEST(ClothSolver, ACantileverDroopsAsItsStiffnessSays) {
    // Peirce (1930): the angle of a strip that is held level tells its bending length, (B / (rho g))^(1/3).
    const auto jobs = Jobs::own(0);
    for (const float bend : {1e-5f, 1e-4f}) {
        FabricMaterial material = cotton();
        material.bend_n_m = bend;
        const float length = 1.8f * std::cbrt(bend / (material.density_kg_m2 * 9.81f)), step = length / 12.0f;
        Sheet strip(14, 5, step);
        for (Vec3& p : strip.positions) p = Vec3(p.x, 0.0f, -p.y);  // level, along +Z
        for (uint32_t i = 0; i < 2 * strip.columns; ++i) strip.simulated[i] = 0;
        FabricData data = strip.cook(material);
        data.tethers.clear();
        ClothSettings settings;
        settings.substeps = 512;
        settings.damping = 0.97f;
        settings.sleeps = false;
        Cloth cloth(fabric(std::move(data)), settings, strip.positions);
        for (int frame = 0; frame < 240; ++frame) cloth.step(kFrame_s, strip.positions, {}, *jobs);
        const Vec3 &tip = cloth.positions()[strip.at(13, 2)], &edge = strip.positions[strip.at(1, 2)];
        const float angle = std::atan2(edge.y - tip.y, tip.z - edge.z);
        const float bending_length = length * std::cbrt(std::cos(0.5f * angle) / (8.0f * std::tan(angle)));
        const float found = material.density_kg_m2 * 9.81f * bending_length * bending_length * bending_length;
        EXPECT_NEAR(found, bend, 0.25f * bend);
    }
}

TEST(ClothSolver, FewSubstepsGetMorePasses) {
    // A strip that hangs: what its edges are stretched by is what a frame's passes leave.
    const auto jobs = Jobs::own(0);
    const auto stretch = [&](uint32_t substeps) {
        Sheet strip(25, 5, 0.02f);
        strip.pin_top();
        FabricData data = strip.cook(cotton());
        data.tethers.clear();
        ClothSettings settings;
        settings.substeps = substeps;
        settings.damping = 0.9f;
        settings.sleeps = false;
        Cloth cloth(fabric(std::move(data)), settings, strip.positions);
        for (int frame = 0; frame < 240; ++frame) cloth.step(kFrame_s, strip.positions, {}, *jobs);
        return cloth.stats().strain_mean;
    };
    // With n sub-steps of one pass it goes as 1 / n^2: 1 would stretch 3.9 times as much as 2. With four
    // passes a frame for both it is 2.6 times.
    EXPECT_LT(stretch(1), 3.0f * stretch(2));
}

TEST(ClothSolver, LongStepIsClamped) {
    const auto jobs = Jobs::own(0);
    const std::vector<Vec3> start{{0, 10, 0}};
    Cloth tenth(lone_vertex(), undamped(), start), minute(lone_vertex(), undamped(), start);
    tenth.step(0.1f, start, {}, *jobs);
    minute.step(60.0f, start, {}, *jobs);
    EXPECT_EQ(tenth.state_hash(), minute.state_hash());
}

TEST(ClothSolver, StrainIsZeroAtRestAndOnePercentWhenPulledByOnePercent) {
    const Sheet sheet(4, 4, 0.02f);
    const auto data = fabric(sheet.cook(cotton()));
    Cloth cloth(data, {}, sheet.positions);
    for (const float strain : cloth.strain()) EXPECT_NEAR(strain, 0.0f, 1e-5f);
    std::vector<Vec3> pulled = sheet.positions;
    for (Vec3& p : pulled) p *= 1.01f;
    cloth.reset(pulled);
    for (const float strain : cloth.strain()) EXPECT_NEAR(strain, 0.01f, 1e-4f);
    EXPECT_NEAR(cloth.stats().strain_mean, 0.01f, 1e-4f);
    EXPECT_NEAR(cloth.stats().strain_max, 0.01f, 1e-4f);
    EXPECT_NEAR(cloth.stats().strain_p99, 0.01f, 1.1e-3f);
    EXPECT_EQ(cloth.stats().simulated_count, 16u);
}

TEST(ClothSolver, OfShortEdgesTheLargestStrainIsAFractionOfTwoCentimetres) {
    const Sheet sheet(4, 4, 0.005f);
    Cloth cloth(fabric(sheet.cook(cotton())), {}, sheet.positions);
    std::vector<Vec3> pulled = sheet.positions;
    for (Vec3& p : pulled) p *= 2.0f;
    cloth.reset(pulled);
    for (const float strain : cloth.strain()) EXPECT_NEAR(strain, 1.0f, 1e-3f);
    // The longest, diagonals of 7 mm, are 7 mm too long.
    EXPECT_NEAR(cloth.stats().strain_max, std::sqrt(2.0f) * 0.005f / 0.02f, 1e-3f);
    EXPECT_NEAR(cloth.stats().strain_mean, 1.0f, 1e-3f);
}

}  // namespace
}  // namespace vfit
