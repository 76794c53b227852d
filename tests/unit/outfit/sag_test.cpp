// Hanging cloth without the stretch that its weight and few sub-steps leave.
#include <gtest/gtest.h>

#include <algorithm>

#include "outfit/sag.h"
#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;

/// A strip that hangs from its first row.
struct Strip {
    Sheet sheet{41, 5, 0.02f};
    std::vector<Vec2> cut;
    Strip() {
        sheet.pin_top();
        for (const uint32_t v : sheet.indices) cut.emplace_back(sheet.positions[v].x, sheet.positions[v].y);
    }
    std::vector<Vec3> raised(const std::vector<Vec3>& worn, const Sagging& sagging) const {
        return without_sag({worn, sheet.indices, cut, {}, {}}, sheet.simulated, sagging);
    }
};

constexpr Sagging kUsual{9.81f, 1.0f / 480.0f};

TEST(Sag, StretchThatWeightExplainsIsTakenOut) {
    const Strip strip;
    std::vector<Vec3> worn = strip.sheet.positions;
    for (Vec3& p : worn) p.y *= 1.03f;
    const auto raised = strip.raised(worn, kUsual);
    // All but the lowest bands, on which hardly anything hangs.
    for (uint32_t row = 0; row < 36; ++row)
        EXPECT_NEAR(raised[strip.sheet.at(row, 2)].y, strip.sheet.positions[strip.sheet.at(row, 2)].y, 0.001f)
            << row;
    for (size_t v = 0; v < worn.size(); ++v)
        EXPECT_TRUE(raised[v].x == worn[v].x && raised[v].z == worn[v].z);
}

TEST(Sag, WhatWeightCannotDoStays) {
    const Strip strip;
    std::vector<Vec3> worn = strip.sheet.positions;
    for (Vec3& p : worn) p.y *= 1.1f;
    const float lowest = worn.back().y;
    EXPECT_NEAR(strip.raised(worn, {9.81f, 1.0f / 7680.0f}).back().y, lowest, 0.001f) << "128 sub-steps";
    EXPECT_EQ(strip.raised(worn, {0.0f, 1.0f / 480.0f}).back().y, lowest) << "without weight";
    EXPECT_EQ(strip.raised(worn, {9.81f, 0.0f}).back().y, lowest);
}

TEST(Sag, AsItHangsWithFewSubstepsItIsToldAsWithMany) {
    const Strip strip;
    const auto jobs = Jobs::own(0);
    const auto hung = [&](uint32_t substeps) {
        ClothSettings settings;
        settings.substeps = substeps;
        FabricData data = strip.sheet.cook(cotton());
        data.tethers.clear();  // they hold what hangs straight; of a garment, they go through the body
        Cloth cloth(fabric(std::move(data)), settings, strip.sheet.positions);
        for (int i = 0; i < 600; ++i) cloth.step(kFrame_s, strip.sheet.positions, {}, *jobs);
        EXPECT_NEAR(cloth.substep_s(), kFrame_s / float(substeps), 1e-6f);
        return std::pair(cloth.positions().back().y,
                         strip.raised(cloth.positions(), {9.81f, cloth.substep_s()}).back().y);
    };
    const auto [few, few_raised] = hung(6);
    const float cut = strip.sheet.positions.back().y;
    EXPECT_LT(few, cut - 0.02f) << "it does sag";
    EXPECT_NEAR(few_raised, cut, 0.005f);
    EXPECT_NEAR(hung(64).second, cut, 0.005f);
}

TEST(Sag, WhatHangsOnNothingOrIsNothingIsLeft) {
    Strip strip;
    strip.sheet.simulated.assign(strip.sheet.positions.size(), 1);
    std::vector<Vec3> worn = strip.sheet.positions;
    for (Vec3& p : worn) p.y *= 1.03f;
    EXPECT_EQ(strip.raised(worn, kUsual), worn);
    EXPECT_TRUE(without_sag({{}, {}, {}, {}, {}}, {}, kUsual).empty());
}

}  // namespace
}  // namespace vfit
