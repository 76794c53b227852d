// Outlines of cut meshes against closed forms.
#include "geometry/section.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "unit/geometry/mesh_shapes.h"

namespace vfit {
namespace {

using namespace test;

Section cut_mesh(const Mesh& mesh, const Vec3& point, const Vec3& normal) {
    return cut(mesh.positions, mesh.indices, point, normal);
}

TEST(Section, OfACylinderIsItsCircle) {
    const Section s = cut_mesh(cylinder(0.2f, 1.0f, 7, 360), {0, 0.4f, 0}, {0, 2, 0});
    ASSERT_EQ(s.loops.size(), 1u);
    EXPECT_TRUE(s.chains.empty());
    EXPECT_NEAR(perimeter(s.loops[0]), 2.0f * kPi * 0.2f, 2e-4f);
    EXPECT_NEAR(area(s.loops[0]), kPi * 0.04f, 2e-4f);  // positive: counter-clockwise
    for (const Vec2& p : s.loops[0]) EXPECT_NEAR(s.lift(p).y, 0.4f, 1e-6f);
}

TEST(Section, OfAnEllipsoidHasRamanujansPerimeter) {
    const Vec3 radii(0.25f, 0.6f, 0.15f);
    const Mesh mesh = ellipsoid(radii, 300, 360);
    for (const float y : {-0.5f, -0.2f, 0.013f, 0.31f, 0.55f}) {
        const float shrink = std::sqrt(1.0f - y * y / (radii.y * radii.y));
        const Section s = cut_mesh(mesh, {0, y, 0}, {0, 1, 0});
        ASSERT_EQ(s.loops.size(), 1u);
        EXPECT_NEAR(perimeter(s.loops[0]), ellipse_perimeter(radii.x * shrink, radii.z * shrink), 3e-4f);
        const Extent e = extent(s.loops[0]);
        EXPECT_NEAR(e.breadth(), 2.0f * radii.x * shrink, 3e-4f);
        EXPECT_NEAR(e.depth(), 2.0f * radii.z * shrink, 3e-4f);
    }
}

TEST(Section, InHorizontalCutsPointsLeftAndBack) {
    const Section s = cut_mesh(cylinder(0.2f, 1.0f, 7, 36), {0, 0.4f, 0}, {0, 1, 0});
    EXPECT_EQ(s.u, Vec3(1, 0, 0));
    EXPECT_EQ(s.v, Vec3(0, 0, -1));
}

TEST(Section, AlongATorusIsARingWithAHoleAcrossItTwoDisks) {
    const Mesh mesh = torus(0.3f, 0.1f, 90, 180);
    const Section flat = cut_mesh(mesh, {0, 0.001f, 0}, {0, 1, 0});
    ASSERT_EQ(flat.loops.size(), 2u);
    std::vector<float> areas = {area(flat.loops[0]), area(flat.loops[1])};
    std::sort(areas.begin(), areas.end());
    EXPECT_NEAR(areas[0], -kPi * 0.04f, 5e-4f);  // the hole runs clockwise
    EXPECT_NEAR(areas[1], kPi * 0.16f, 1e-3f);
    const Section across = cut_mesh(mesh, {0, 0, 0.0005f}, {0, 0, 1});
    ASSERT_EQ(across.loops.size(), 2u);
    for (const auto& loop : across.loops) EXPECT_NEAR(area(loop), kPi * 0.01f, 1e-4f);
}

TEST(Section, ThroughVerticesExactlyIsClosedAndWithoutDoubledPoints) {
    const Mesh mesh = cylinder(0.2f, 1.0f, 8, 64);
    for (const float y : {0.125f, 0.5f, 0.875f, 1.0f}) {  // rows of vertices; 1: the lid lies in the plane
        const Section s = cut_mesh(mesh, {0, y, 0}, {0, 1, 0});
        ASSERT_EQ(s.loops.size(), 1u) << y;
        EXPECT_TRUE(s.chains.empty());
        EXPECT_EQ(s.loops[0].size(), 64u);
        EXPECT_NEAR(perimeter(s.loops[0]), 64.0f * 0.4f * std::sin(kPi / 64.0f), 1e-5f);
    }
    EXPECT_TRUE(cut_mesh(mesh, {0, 0, 0}, {0, 1, 0}).loops.empty());  // all of it is on or above the plane
    // Down the axis: through both poles and rows of vertices.
    const Section lengthwise = cut_mesh(mesh, {0, 0, 0}, {1, 0, 0});
    ASSERT_EQ(lengthwise.loops.size(), 1u);
    EXPECT_NEAR(perimeter(lengthwise.loops[0]), 2.8f, 1e-4f);
}

TEST(Section, OfAnyPlaneThroughAClosedMeshIsClosed) {
    const Mesh mesh = torus(0.3f, 0.1f, 16, 24);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        // Planes through three of its own vertices, so that many lie in the plane.
        const Vec3 a = mesh.positions[i], b = mesh.positions[(i * 7 + 13) % mesh.positions.size()],
                   c = mesh.positions[(i * 31 + 101) % mesh.positions.size()];
        const Vec3 normal = glm::cross(b - a, c - a);
        if (glm::length(normal) < 1e-6f) continue;
        EXPECT_TRUE(cut_mesh(mesh, a, normal).chains.empty()) << i;
    }
}

TEST(Section, OfAnOpenMeshKeepsItsEndsOpen) {
    const Mesh mesh = tube(0.2f, 1.0f, 8, 64);
    EXPECT_EQ(cut_mesh(mesh, {0, 0.3f, 0}, {0, 1, 0}).loops.size(), 1u);
    const Section lengthwise = cut_mesh(mesh, {0.001f, 0, 0}, {1, 0, 0});
    EXPECT_TRUE(lengthwise.loops.empty());
    ASSERT_EQ(lengthwise.chains.size(), 2u);
    for (const auto& chain : lengthwise.chains) {
        EXPECT_NEAR(glm::distance(chain.front(), chain.back()), 1.0f, 1e-4f);
        EXPECT_NEAR(perimeter(chain), 2.0f, 1e-4f);  // there and straight back
    }
}

TEST(Section, OfSomeTrianglesIsTheirPartOfTheOutline) {
    const Mesh mesh = tube(0.2f, 1.0f, 8, 64);
    std::vector<uint32_t> half;
    for (size_t i = 0; i < mesh.indices.size(); i += 3)
        if (mesh.positions[mesh.indices[i]].x >= 0.0f)
            half.insert(half.end(), &mesh.indices[i], &mesh.indices[i] + 3);
    const Section s = cut(mesh.positions, half, {0, 0.3f, 0}, {0, 1, 0});
    EXPECT_TRUE(s.loops.empty());
    ASSERT_EQ(s.chains.size(), 1u);
    EXPECT_NEAR(hull_perimeter(s.points()), 0.2f * kPi + 0.4f, 0.05f);  // half the circle and its chord
}

TEST(Section, MissesWhatItDoesNotMeet) {
    const Section s = cut_mesh(cylinder(0.2f, 1.0f, 8, 64), {0, 1.5f, 0}, {0, 1, 0});
    EXPECT_TRUE(s.loops.empty());
    EXPECT_TRUE(s.points().empty());
    EXPECT_EQ(hull_perimeter(s.points()), 0.0f);
}

TEST(Section, RefusesBadInput) {
    const Mesh mesh = cylinder(0.2f, 1.0f, 8, 64);
    EXPECT_THROW(cut_mesh(mesh, {0, 0, 0}, {0, 0, 0}), Error);
    EXPECT_THROW(cut_mesh(mesh, {0, 0, 0}, {0, std::nanf(""), 0}), Error);
    EXPECT_THROW(cut(mesh.positions, std::vector<uint32_t>{0, 1}, {0, 0.5f, 0}, {0, 1, 0}), Error);
    EXPECT_THROW(cut(mesh.positions, std::vector<uint32_t>{0, 1, 9999}, {0, 0.5f, 0}, {0, 1, 0}), Error);
}

TEST(Hull, OfAConcaveOutlineIsShorterThanTheOutline) {
    // A square of side 1 with a notch: the tape spans the notch.
    const std::vector<Vec2> notched = {{0, 0}, {1, 0}, {1, 1}, {0.5f, 0.25f}, {0, 1}};
    EXPECT_NEAR(perimeter(notched), 3.0f + 2.0f * std::hypot(0.5f, 0.75f), 1e-5f);
    EXPECT_NEAR(hull_perimeter(notched), 4.0f, 1e-6f);
    EXPECT_EQ(convex_hull(notched).size(), 4u);
    EXPECT_GT(area(convex_hull(notched)), 0.0f);
}

TEST(Hull, DropsPointsOnItsEdgesAndDoubledOnes) {
    std::vector<Vec2> square;
    for (int i = 0; i <= 10; ++i)
        for (int k = 0; k <= 10; ++k) square.insert(square.end(), 2, Vec2(0.1f * float(i), 0.1f * float(k)));
    EXPECT_EQ(convex_hull(square).size(), 4u);
    EXPECT_NEAR(hull_perimeter(square), 4.0f, 1e-5f);
}

TEST(Hull, OfFewPointsIsThesePoints) {
    EXPECT_EQ(hull_perimeter({}), 0.0f);
    EXPECT_EQ(hull_perimeter(std::vector<Vec2>{{1, 1}, {1, 1}}), 0.0f);
    EXPECT_NEAR(hull_perimeter(std::vector<Vec2>{{0, 0}, {1, 0}, {0.5f, 0}}), 2.0f, 1e-6f);
}

TEST(Outline, EnclosesWhatLiesInIt) {
    const std::vector<Vec2> notched = {{0, 0}, {1, 0}, {1, 1}, {0.5f, 0.25f}, {0, 1}};
    EXPECT_TRUE(encloses(notched, {0.5f, 0.1f}));
    EXPECT_TRUE(encloses(notched, {0.1f, 0.7f}));
    EXPECT_FALSE(encloses(notched, {0.5f, 0.7f}));
    EXPECT_FALSE(encloses(notched, {1.5f, 0.5f}));
}

}  // namespace
}  // namespace vfit
