// Sheets with even triangles, and surfaces of which more than two triangles share a side.
#include "cook/model/even_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cook/model/beside.h"
#include "cook/model/obj.h"
#include "core/error.h"
#include "geometry/borders.h"
#include "geometry/mesh_query.h"
#include "mesh_files.h"

namespace vfit {
namespace {

struct Even {
    Model source, even;
    Pieces before, after;
};

Even even_of(const std::string& obj, float side_m = 0.02f) {
    Even out;
    out.source = read_obj(obj, Beside());
    out.before = make_pieces(make_soup(out.source, 1.0f));
    out.even = with_even_triangles(out.before, side_m);
    out.after = make_pieces(soup_of_joined(out.even, 1.0f));
    return out;
}

float area_of(const Pieces& pieces) {
    float out = 0.0f;
    for (const Piece& piece : pieces.list) out += piece.area_m2;
    return out;
}

/// Nearly all sides are about as long as asked, no triangle is a sliver, and it lies where the source does.
void expect_even(const Even& even, float side_m, float off_m) {
    ASSERT_EQ(even.after.list.size(), even.before.list.size());
    EXPECT_NEAR(area_of(even.after), area_of(even.before), 0.02f * area_of(even.before));
    const MeshQuery source(even.before.places, even.before.list[0].indices);
    size_t sides = 0, odd = 0;
    for (const Piece& piece : even.after.list)
        for (const ModelTriangle& t : piece.triangles) {
            float longest = 0.0f;
            for (size_t k = 0; k < 3; ++k) {
                const float length =
                    glm::length(even.after.places[t.vertex[k]] - even.after.places[t.vertex[(k + 1) % 3]]);
                longest = std::max(longest, length);
                ++sides, odd += length < 0.5f * side_m || length > 1.6f * side_m;
            }
            EXPECT_GT(2.0f * area_of(even.after.places, t), 0.1f * longest * longest);
        }
    EXPECT_LT(odd, sides / 50);
    for (const uint32_t v : even.after.list[0].indices)
        EXPECT_LT(source.closest(even.after.places[v]).distance, off_m);
}

TEST(EvenTriangles, FineAndCoarseSheetsKeepShapeAndOpenings) {
    for (const auto& [columns, rows] :
         {std::pair(160, 80), std::pair(36, 20), std::pair(12, 3), std::pair(200, 4)}) {
        TubeMesh tube;
        tube.columns = columns, tube.rows = rows;
        const Even even = even_of(obj_of(tube));
        expect_even(even, 0.02f, 0.003f);
        ASSERT_EQ(even.after.list[0].openings.size(), 2u) << columns;
        for (const auto& opening : even.after.list[0].openings) {
            const float length = length_around(even.after.places, opening);
            float nearest = INFINITY;
            for (const auto& old : even.before.list[0].openings)
                nearest = std::min(nearest, std::abs(length_around(even.before.places, old) - length));
            EXPECT_LT(nearest, 0.02f * length);
        }
    }
}

TEST(EvenTriangles, SliversAndNeedlesGoInIt) {
    // A fan of a hundred needles in place of a square, and a corner that lies on a side.
    TubeMesh tube;
    const std::vector<Vec3> p = tube.positions();
    const std::vector<uint32_t> squares = tube.squares();
    std::vector<uint32_t> rest(squares.begin() + 4, squares.end());
    std::string obj = obj_vertices(p, tube.uvs()) + obj_faces(rest, 4);
    const Vec3 a = p[squares[0]], b = p[squares[1]];
    size_t next = p.size() + 1;
    constexpr int kNeedles = 100;
    for (int i = 1; i < kNeedles; ++i) {
        const Vec3 at = glm::mix(a, b, float(i) / float(kNeedles));
        obj += text("v ", at.x, " ", at.y, " ", at.z, "\n");
    }
    for (int i = 0; i < kNeedles; ++i)
        obj += text("f ", i == 0 ? size_t(squares[0]) + 1 : next + size_t(i) - 1, " ",
                    i == kNeedles - 1 ? size_t(squares[1]) + 1 : next + size_t(i), " ", squares[3] + 1, "\n");
    obj += text("f ", squares[1] + 1, " ", squares[2] + 1, " ", squares[3] + 1, "\n");
    const Even even = even_of(obj);
    expect_even(even, 0.02f, 0.003f);
}

TEST(EvenTriangles, SheetsThatTouchStayApart) {
    TubeMesh tube, other;
    other.radius_m += 0.002f;
    std::vector<uint32_t> over = other.squares();
    for (uint32_t& v : over) v += uint32_t(tube.positions().size());
    const Even even =
        even_of(obj_of(tube) + obj_vertices(other.positions(), other.uvs()) + obj_faces(over, 4));
    ASSERT_EQ(even.after.list.size(), 2u);
    for (const Piece& piece : even.after.list) EXPECT_EQ(piece.openings.size(), 2u);
    EXPECT_NEAR(area_of(even.after), area_of(even.before), 0.01f * area_of(even.before));
}

TEST(MeshPieces, PartsWhatIsMoreThanTwoAtASide) {
    const TubeMesh tube;
    const std::vector<Vec3> p = tube.positions();
    // A flap along three sides of the tube.
    std::string obj = obj_of(tube);
    const auto at = [&](int r, int c) { return r * (tube.columns + 1) + c; };
    for (int r = 5; r < 9; ++r) {
        const Vec3 out = p[size_t(at(r, 4))] * Vec3(1.2f, 1.0f, 1.2f);
        obj += text("v ", out.x, " ", out.y, " ", out.z, "\n");
    }
    for (int r = 5; r < 8; ++r)
        obj += text("f ", at(r, 4) + 1, " ", at(r + 1, 4) + 1, " ", int(p.size()) + r - 3, " ",
                    int(p.size()) + r - 4, "\n");
    const Model model = read_obj(obj, Beside());
    const Pieces pieces = make_pieces(make_soup(model, 1.0f));
    ASSERT_EQ(pieces.list.size(), 2u);
    EXPECT_EQ(pieces.list[0].triangles.size(), tube.triangles().size() / 3);
    EXPECT_EQ(pieces.list[0].openings.size(), 2u);
    EXPECT_EQ(pieces.list[1].triangles.size(), 6u);
    ASSERT_EQ(pieces.notes.size(), 1u);
    EXPECT_EQ(pieces.notes[0], "3 sides of more than two triangles were parted");
}

/// A band of so many squares that comes back with half a turn.
std::string turned_band(int squares) {
    std::string obj;
    for (int i = 0; i < squares; ++i) {
        const float a = 2.0f * kPi * float(i) / float(squares);
        for (const float side : {-0.1f, 0.1f})
            obj += text("v ", (0.3f + side * std::sin(0.5f * a)) * std::sin(a), " ",
                        1.0f + side * std::cos(0.5f * a), " ",
                        (0.3f + side * std::sin(0.5f * a)) * std::cos(a), "\n");
    }
    for (int i = 0; i < squares; ++i) {
        const int a = 2 * i + 1, b = i < squares - 1 ? a + 2 : 2, c = i < squares - 1 ? a + 3 : 1;
        obj += text("f ", a, " ", b, " ", c, "\nf ", a, " ", c, " ", a + 1, "\n");
    }
    return obj;
}

TEST(MeshPieces, PartsWhereTheOutsideBecomesTheInside) {
    const Model model = read_obj(turned_band(80), Beside());
    const Pieces pieces = make_pieces(make_soup(model, 1.0f));
    ASSERT_EQ(pieces.list.size(), 1u);
    EXPECT_EQ(pieces.list[0].openings.size(), 1u);  // a strip
    EXPECT_EQ(pieces.notes.front(), "1 sides were parted where its outside became its inside");
    try {
        const Model odd = read_obj(turned_band(10), Beside());
        make_pieces(make_soup(odd, 1.0f));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("the cloth has no outside: around the side from"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace vfit
