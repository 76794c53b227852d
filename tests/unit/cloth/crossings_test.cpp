// Triangles that go through each other: found, kept from it, taken back, and lifted off meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "cloth/contact/triangle_groups.h"
#include "cloth/contact/untangle.h"
#include "cloth/crossings.h"
#include "cloth/garment/borders.h"
#include "cloth/garment/clear_skin.h"
#include "cloth_support.h"
#include "two_sheets.h"

namespace vfit::test {
namespace {

TEST(Crossings, AreThoseOfAllPairs) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(0.0f, 0.1f), off(-0.015f, 0.015f);
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    for (uint32_t t = 0; t < 300; ++t) {
        const Vec3 at(place(random), place(random), place(random));
        for (uint32_t k = 0; k < 3; ++k) {
            positions.push_back(at + Vec3(off(random), off(random), off(random)));
            indices.push_back(3 * t + k);
        }
    }
    std::set<TrianglePair> all, found;
    for (uint32_t a = 0; a < 300; ++a)
        for (uint32_t b = a + 1; b < 300; ++b)
            if (cross({{positions[3 * a], positions[3 * a + 1], positions[3 * a + 2]}},
                      {{positions[3 * b], positions[3 * b + 1], positions[3 * b + 2]}}))
                all.insert({a, b});
    const auto jobs = Jobs::own(2);
    TriangleGroups groups(positions, indices);
    groups.move(positions, *jobs);
    std::vector<TrianglePair> pairs;
    groups.find_crossings(false, pairs, *jobs);
    for (const TrianglePair& pair : pairs) found.insert(std::minmax(pair.first, pair.second));
    EXPECT_GT(all.size(), 100u);
    EXPECT_EQ(found, all);
    EXPECT_EQ(pairs.size(), all.size()) << "each once";
}

TEST(Crossings, FlatPiecesAreLeftOutAndFoldedOnesAreNot) {
    TwoSheets sheets(9, 0.02f, {0.003f, 0.05f, 0.004f});
    EXPECT_TRUE(sheets.crossed(true).empty());
    for (uint32_t v = 0; v < sheets.of_one; ++v)
        sheets.positions[v].y += 0.6f * (sheets.positions[v].x - 0.01f);  // through the upper one
    EXPECT_FALSE(sheets.crossed(true).empty());
    EXPECT_EQ(sheets.crossed(true).size(), sheets.crossed(false).size());
}

TEST(Crossings, FoldsOfSmallTrianglesBesideLargeOnesAreNotLeftOut) {
    // A strip whose triangles shrink along it, rolled up: by their areas, the large ones would hide which way
    // the small ones face.
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    float way = 0.0f, side = 0.03f;
    for (uint32_t r = 0; r < 26; ++r, way += side, side *= 0.86f) {
        const float angle = way < 0.1f ? 0.0f : (way - 0.1f) / 0.006f, radius = 0.006f;
        const Vec3 at = way < 0.1f
                            ? Vec3(0, 0, way)
                            : Vec3(0, radius * (1.0f - std::cos(angle)), 0.1f + radius * std::sin(angle));
        positions.push_back(at + Vec3(0.001f * float(r % 2), 0, 0)),
            positions.push_back(at + Vec3(0.02f + 0.001f * float(r % 3), 0, 0));
        if (r == 25) break;
        const uint32_t a = 2 * r;
        indices.insert(indices.end(), {a, a + 1, a + 3, a, a + 3, a + 2});
    }
    const auto jobs = Jobs::own(0);
    TriangleGroups groups(positions, indices);
    groups.move(positions, *jobs);
    std::vector<TrianglePair> all, but_flat;
    groups.find_crossings(false, all, *jobs);
    groups.find_crossings(true, but_flat, *jobs);
    ASSERT_GT(all.size(), 0u) << "the scene would show it";
    EXPECT_EQ(but_flat, all);
}

TEST(Untangle, AVertexThatPokesThroughGoesBack) {
    TwoSheets sheets(5, 0.02f, {0.007f, 0.004f, 0.006f});
    sheets.positions[12].y = 0.009f;  // the middle of the lower one
    auto pairs = sheets.crossed();
    ASSERT_FALSE(pairs.empty());
    Untangle untangle;
    const std::vector<uint8_t> fixed(sheets.positions.size(), 0);
    int round = 0;
    for (; round < 40 && !pairs.empty(); ++round) {
        EXPECT_FALSE(untangle.move(pairs, sheets.indices, fixed, 0.001f, sheets.positions).empty());
        pairs = sheets.crossed();
    }
    EXPECT_TRUE(pairs.empty()) << "after " << round << " rounds";
    for (size_t v = 0; v < sheets.positions.size(); ++v)
        EXPECT_LT(std::abs(sheets.positions[v].y - 0.004f), 0.012f);
}

TEST(Untangle, WhatIsFixedStays) {
    TwoSheets sheets(5, 0.02f, {0.007f, 0.004f, 0.006f});
    sheets.positions[12].y = 0.009f;
    const std::vector<Vec3> before = sheets.positions;
    Untangle untangle;
    untangle.move(sheets.crossed(), sheets.indices, std::vector<uint8_t>(before.size(), 1), 0.001f,
                  sheets.positions);
    EXPECT_EQ(sheets.positions, before);
}

TEST(ClearSkin, SkinThatStandsOutBetweenVerticesIsCleared) {
    TwoSheets body(9, 0.01f, {0.0f, -0.03f, 0.0f});  // its upper sheet counts; triangles face up
    body.indices.resize(body.indices.size() / 2);
    body.positions[40].y = 0.008f;
    const MeshQuery query(body.positions, body.indices);
    std::vector<Vec3> cloth{{0.005f, 0.004f, 0.005f}, {0.04f, 0.004f, 0.09f}, {0.08f, 0.004f, 0.01f}};
    const std::vector<uint32_t> triangle{0, 1, 2};
    const auto crossed = [&] {
        return crossed_triangles({cloth, triangle}, {body.positions, body.indices}).size();
    };
    ASSERT_GT(crossed(), 0u);
    clear_skin({body.positions, body.indices, query}, triangle, cloth);
    EXPECT_EQ(crossed(), 0u);
    for (const Vec3& p : cloth) EXPECT_GT(p.y, 0.006f);
}

/// Of 4 mm squares, with a bump 10 mm wide, and high.
struct BumpyGround {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;

    explicit BumpyGround(float steepness = 1.0f) {
        constexpr uint32_t kSide = 61;
        for (uint32_t r = 0; r < kSide; ++r)
            for (uint32_t c = 0; c < kSide; ++c) {
                const Vec3 p(0.004f * float(c), 0.0f, 0.004f * float(r));
                positions.push_back(
                    p + Vec3(0.0f,
                             steepness * std::max(0.0f, 0.01f - glm::length(p - Vec3(0.128f, 0.0f, 0.116f))),
                             0.0f));
                if (r + 1 == kSide || c + 1 == kSide) continue;
                const uint32_t a = r * kSide + c, b = a + 1, d = a + kSide, e = d + 1;
                indices.insert(indices.end(), {a, d, e, a, e, b});
            }
    }
    size_t crossed(const Cloth& cloth, const Sheet& sheet) const {
        return crossed_triangles({cloth.positions(), sheet.indices}, {positions, indices}).size();
    }
};

/// Of large triangles, at that height over it.
std::vector<Vec3> over_ground(const Sheet& sheet, float height) {
    std::vector<Vec3> out;
    for (const Vec3& p : sheet.positions) out.emplace_back(0.01f + p.x, height, 0.01f - p.y);
    return out;
}

TEST(TriangleContact, ClothOfLargeTrianglesStaysOverASmallBump) {
    const auto jobs = Jobs::own(0);
    const BumpyGround ground;
    const Sheet sheet(9, 9, 0.025f);
    const std::vector<Vec3> start = over_ground(sheet, 0.02f);
    for (const bool meets_triangles : {false, true}) {
        ClothSettings settings;
        settings.sleeps = false;
        settings.self_thickness_m = meets_triangles ? 0.004f : 0.0f;
        Cloth cloth(fabric(sheet.cook(cotton())), settings, start);
        const uint32_t mesh = cloth.add_mesh(ground.positions.size(), ground.indices);
        size_t crossed = 0;
        for (int frame = 0; frame < 120; ++frame) {
            cloth.move_mesh(mesh, ground.positions);
            cloth.step(kFrame_s, start, {}, *jobs);
            crossed = std::max(crossed, ground.crossed(cloth, sheet));
        }
        if (meets_triangles)
            EXPECT_EQ(crossed, 0u);
        else
            EXPECT_GT(crossed, 0u) << "the scene would show it";
    }
}

TEST(TriangleContact, InOtherLengthsItMeetsTheSameMeshes) {
    const auto jobs = Jobs::own(0);
    const BumpyGround ground;
    const Sheet sheet(9, 9, 0.025f);
    const std::vector<Vec3> start = over_ground(sheet, 0.02f);
    ClothSettings settings;
    settings.sleeps = false;
    settings.self_thickness_m = 0.004f;
    const auto cotton_sheet = fabric(sheet.cook(cotton()));
    Cloth first(cotton_sheet, settings, start);
    const uint32_t mesh = first.add_mesh(ground.positions.size(), ground.indices);
    Cloth second = first.with_fabric(cotton_sheet);
    for (int frame = 0; frame < 120; ++frame) {
        second.move_mesh(mesh, ground.positions);
        second.step(kFrame_s, start, {}, *jobs);
        EXPECT_EQ(ground.crossed(second, sheet), 0u) << frame;
    }
    for (const Vec3& p : second.positions()) EXPECT_LT(p.y, 0.019f) << "it fell on the ground";
}

TEST(TriangleContact, ItGoesToOtherPlacesButNotThroughItself) {
    const auto jobs = Jobs::own(0);
    const TwoSheets sheets(8, 0.02f, {0.004f, 0.005f, 0.005f});
    TwoSheets wanted = sheets;
    for (Vec3& place : wanted.positions) place.x += 0.05f;
    for (const uint32_t v : {27u, 28u, 35u, 36u})
        wanted.positions[sheets.of_one + v].y -= 0.012f;  // the upper one, through the lower
    ASSERT_GT(wanted.crossed().size(), 0u);
    ClothSettings settings;
    settings.self_thickness_m = 0.004f;
    Cloth cloth(fabric(sheets.fabric()), settings, sheets.positions);
    cloth.go_to(wanted.positions, *jobs);
    TwoSheets now = sheets;
    now.positions = cloth.positions();
    EXPECT_EQ(now.crossed().size(), 0u);
    for (const size_t corner : {0u, 7u, sheets.of_one, sheets.of_one + 7u})
        EXPECT_LT(glm::distance(now.positions[corner], wanted.positions[corner]), 1e-5f) << corner;
    cloth.reset(wanted.positions);
    now.positions = cloth.positions();
    EXPECT_GT(now.crossed().size(), 0u) << "reset does";
}

TEST(Borders, OfTwoSheetsAreTwoClosedLines) {
    const TwoSheets sheets(4, 0.02f, {0.0f, 0.01f, 0.0f});
    const auto lines = border_lines(sheets.indices);
    ASSERT_EQ(lines.size(), 2u);
    for (const auto& line : lines) {
        EXPECT_EQ(line.size(), 12u);
        for (size_t i = 0; i < line.size(); ++i)
            EXPECT_EQ(sheets.indices[next_corner(line[i])], sheets.indices[line[(i + 1) % line.size()]]);
    }
}

TEST(Crossings, CrossingsAreFoundOnceAndNeighboursAreNone) {
    const std::vector<Vec3> positions{{0, 0, 0},          {1, 0, 0},          {0, 0, 1}, {0.2f, -0.5f, 0.2f},
                                      {0.3f, 0.5f, 0.2f}, {0.2f, 0.5f, 0.4f}, {1, 0, 1}};
    const std::vector<uint32_t> crossed{0, 1, 2, 3, 4, 5}, beside{0, 1, 2, 1, 6, 2};
    ASSERT_EQ(crossed_triangles(positions, crossed).size(), 1u);
    EXPECT_TRUE(crossed_triangles(positions, beside).empty());
    const std::vector<uint32_t> a{0, 1, 2}, b{3, 4, 5, 1, 6, 2};
    const auto pairs = crossed_triangles({positions, a}, {positions, b});
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0], std::pair(0u, 0u));
}

}  // namespace
}  // namespace vfit::test
