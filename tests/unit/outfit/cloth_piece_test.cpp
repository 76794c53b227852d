// The cloth of one garment among others: what is added for it is met by it alone.
#include "outfit/cloth_piece.h"

#include <gtest/gtest.h>

#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;

/// Two sheets side by side, 1 cm above a floor that is as large as both.
struct TwoOverAFloor {
    std::unique_ptr<Jobs> jobs = Jobs::own(0);
    Sheet sheet{9, 9, 0.02f}, floor{41, 41, 0.02f};
    std::vector<Vec3> start, floor_places;
    std::vector<uint32_t> floor_indices = floor.indices;
    std::optional<Cloth> cloth;

    TwoOverAFloor() {
        for (const float x : {-0.2f, 0.1f})
            for (const Vec3& p : sheet.positions) start.emplace_back(p.x + x, 0.01f, -p.y - 0.08f);
        for (const Vec3& p : floor.positions) floor_places.emplace_back(p.x - 0.4f, 0.0f, -p.y - 0.4f);
        for (size_t i = 0; i < floor_indices.size(); i += 3) {
            const auto at = [&](size_t k) { return floor_places[floor_indices[i + k]]; };
            if (glm::cross(at(1) - at(0), at(2) - at(0)).y < 0.0f)
                std::swap(floor_indices[i + 1], floor_indices[i + 2]);
        }
        const auto one = fabric(sheet.cook(cotton()));
        ClothSettings settings[2];
        for (ClothSettings& of : settings) of.sleeps = false, of.self_thickness_m = 0.004f;
        cloth = Cloth::of_pieces(std::make_shared<const Fabric>(std::vector{one, one}), settings, start);
    }
    ClothPiece piece(size_t i) { return {*cloth, i}; }
    void fall(uint32_t mesh) {
        for (int frame = 0; frame < 20; ++frame) {
            cloth->move_mesh(mesh, floor_places);
            cloth->step(kFrame_s, start, {}, *jobs);
        }
    }
    /// It did not pass the floor.
    bool lies(size_t i) {
        const std::span<const Vec3> places = piece(i).positions();
        return std::all_of(places.begin(), places.end(), [](const Vec3& p) { return p.y > -0.001f; });
    }
};

TEST(ClothPiece, AMeshIsMetByItsOwnPieceAlone) {
    for (const size_t own : {0u, 1u}) {
        TwoOverAFloor two;
        const uint32_t mesh =
            two.piece(own).add_mesh(two.floor_places.size(), two.floor_indices, MeshOf::prop);
        two.fall(mesh);
        EXPECT_TRUE(two.lies(own)) << own;
        EXPECT_FALSE(two.lies(1 - own)) << own;
    }
}

TEST(ClothPiece, SoIsOneInThePlaceOfAnother) {
    TwoOverAFloor two;
    const uint32_t mesh = two.piece(1).add_mesh(two.sheet.positions.size(), two.sheet.indices, MeshOf::prop);
    two.piece(1).replace_mesh(mesh, two.floor_places.size(), two.floor_indices, MeshOf::prop);
    two.fall(mesh);
    EXPECT_TRUE(two.lies(1));
    EXPECT_FALSE(two.lies(0));
}

TEST(ClothPiece, AMaskIsOfItsOwnVertices) {
    TwoOverAFloor two;
    const size_t n = two.sheet.positions.size();
    const std::vector<uint8_t> category(two.floor_places.size(), 2), all(n, 3), none(n, 1);
    const uint32_t first = two.piece(0).add_mesh(two.floor_places.size(), two.floor_indices, MeshOf::solid,
                                                 {category, all}),
                   second = two.piece(1).add_mesh(two.floor_places.size(), two.floor_indices, MeshOf::solid,
                                                  {category, none});
    two.piece(0).set_mesh_mask(first, none);
    two.piece(1).set_mesh_mask(second, all);
    for (int frame = 0; frame < 20; ++frame) two.cloth->move_mesh(first, two.floor_places), two.fall(second);
    EXPECT_FALSE(two.lies(0));
    EXPECT_TRUE(two.lies(1));
    EXPECT_NE(error_of([&] { two.piece(1).set_mesh_mask(second, category); }), "") << "too many";
}

TEST(ClothPiece, ItsNumbersAreTheGarments) {
    TwoOverAFloor two;
    EXPECT_EQ(two.piece(1).indices(), two.sheet.indices);
    EXPECT_EQ(two.piece(1).vertex_count(), two.sheet.positions.size());
    for (size_t i = 0; i < two.piece(1).edge_strain().size(); ++i) {
        EXPECT_EQ(two.piece(1).edge(i).a, two.piece(0).edge(i).a);
        EXPECT_EQ(two.piece(1).edge(i).b, two.piece(0).edge(i).b);
    }
    EXPECT_EQ(two.piece(1).positions()[0], two.start[two.sheet.positions.size()]);
}

}  // namespace
}  // namespace vfit
