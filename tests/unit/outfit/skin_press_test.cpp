// Skin that gives way to cloth: where, by how much, and where it stays.
#include "outfit/skin_press.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "support/allocation_count.h"  // counted by body_jump_test.cpp

namespace vfit {
namespace {

/// A flat square of n x n squares of 1 cm at a height, facing up, with a shape on it.
struct Sheet {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;

    template <typename Height>
    Sheet(uint32_t n, float square_m, const Height& height) {
        for (uint32_t z = 0; z <= n; ++z)
            for (uint32_t x = 0; x <= n; ++x) {
                const float px = square_m * (float(x) - 0.5f * float(n)),
                            pz = square_m * (float(z) - 0.5f * float(n));
                positions.emplace_back(px, height(px, pz), pz);
            }
        for (uint32_t z = 0; z < n; ++z)
            for (uint32_t x = 0; x < n; ++x) {
                const uint32_t a = z * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
                indices.insert(indices.end(), {a, c, b, b, c, d});
            }
    }
};

class SkinPressTest : public testing::Test {
protected:
    static constexpr float kCloth_m = 0.004f;  // above the flat skin
    std::unique_ptr<Jobs> jobs = Jobs::own(2);
    Sheet cloth{10, 0.023f, [](float, float) { return kCloth_m; }};
    std::optional<TriangleGroups> groups;

    static Sheet skin_with_bump(float height_m, float radius_m = 0.03f) {
        return Sheet(30, 0.01f, [=](float x, float z) {
            const float share = std::max(0.0f, 1.0f - std::sqrt(x * x + z * z) / radius_m);
            return height_m * share;
        });
    }
    PressingCloth over() {
        const MeshView mesh{cloth.positions, cloth.indices};
        if (!groups) groups.emplace(mesh.positions, mesh.indices);
        groups->move(mesh.positions, *jobs);
        return {mesh, &*groups};
    }
    SkinPress::Result press(Sheet& skin) {
        SkinPress press(skin.positions, skin.indices);
        const std::vector<Vec3> normals(skin.positions.size(), Vec3(0.0f, 1.0f, 0.0f));
        const PressingCloth cloths[] = {over()};
        return press.press(cloths, normals, skin.positions, *jobs);
    }
    std::vector<TrianglePair> crossed(const Sheet& skin) const {
        return crossed_triangles(MeshView{cloth.positions, cloth.indices},
                                 MeshView{skin.positions, skin.indices});
    }
};

TEST_F(SkinPressTest, SkinBelowClothStays) {
    Sheet skin = skin_with_bump(0.003f);
    const std::vector<Vec3> before = skin.positions;
    const SkinPress::Result result = press(skin);
    EXPECT_EQ(result.pressed, 0u);
    EXPECT_EQ(skin.positions, before);
}

TEST_F(SkinPressTest, ABumpThatComesThroughGivesWayAndTheRestStays) {
    for (const float height_m : {0.005f, 0.009f, 0.015f}) {
        Sheet skin = skin_with_bump(height_m);
        const Sheet before = skin;
        ASSERT_FALSE(crossed(before).empty());
        const SkinPress::Result result = press(skin);
        EXPECT_EQ(result.left_pairs, 0u);
        EXPECT_TRUE(crossed(skin).empty());
        EXPECT_GT(result.pressed, 0u);
        EXPECT_LT(result.deepest_m, height_m);
        for (size_t v = 0; v < skin.positions.size(); ++v) {
            EXPECT_LT(skin.positions[v].y, kCloth_m);
            if (before.positions[v].y == 0.0f) {
                EXPECT_EQ(skin.positions[v], before.positions[v]);
            }
        }
    }
}

TEST_F(SkinPressTest, ClothThatFacesTheSkinPressesAsWell) {
    for (size_t i = 0; i < cloth.indices.size(); i += 3) std::swap(cloth.indices[i], cloth.indices[i + 1]);
    Sheet skin = skin_with_bump(0.009f);
    EXPECT_EQ(press(skin).left_pairs, 0u);
    EXPECT_TRUE(crossed(skin).empty());
}

TEST_F(SkinPressTest, WhatGoesThroughTheClothStaysAsItWas) {
    Sheet skin = skin_with_bump(0.2f, 0.06f);
    const Sheet before = skin;
    const SkinPress::Result result = press(skin);
    EXPECT_EQ(result.left_pairs, crossed(before).size());
    EXPECT_EQ(result.pressed, 0u);
    for (size_t v = 0; v < skin.positions.size(); ++v)
        EXPECT_NEAR(skin.positions[v].y, before.positions[v].y, 1e-6f);
}

TEST_F(SkinPressTest, OnePlaceThatGoesThroughDoesNotKeepAnotherFromGivingWay) {
    const auto heights = [](float x, float z) {
        const auto bump = [&](float at, float height_m, float radius_m) {
            const float away = std::sqrt((x - at) * (x - at) + z * z);
            return height_m * std::max(0.0f, 1.0f - away / radius_m);
        };
        return bump(-0.07f, 0.2f, 0.03f) + bump(0.07f, 0.009f, 0.03f);
    };
    Sheet skin(30, 0.01f, heights);
    EXPECT_GT(press(skin).left_pairs, 0u);
    for (const auto& [of_cloth, of_skin] : crossed(skin))
        EXPECT_LT(skin.positions[skin.indices[3 * of_skin]].x, 0.0f);
}

TEST_F(SkinPressTest, AgainAndAgainDoesNotAllocateAndGivesTheSame) {
    const Sheet posed = skin_with_bump(0.015f);
    SkinPress press(posed.positions, posed.indices);
    const std::vector<Vec3> normals(posed.positions.size(), Vec3(0.0f, 1.0f, 0.0f));
    const PressingCloth cloths[] = {over()};
    std::vector<Vec3> first = posed.positions, again;
    press.press(cloths, normals, first, *jobs);
    again = posed.positions;
    const uint64_t before = test::allocations;
    press.press(cloths, normals, again, *jobs);
    EXPECT_EQ(test::allocations, before);
    EXPECT_EQ(again, first);
}

}  // namespace
}  // namespace vfit
