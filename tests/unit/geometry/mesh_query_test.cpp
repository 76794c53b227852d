// Closest points, inside tests and rays against shapes with known answers.
#include "geometry/mesh_query.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <random>

#include "core/error.h"
#include "math/closest_point.h"
#include "unit/geometry/mesh_shapes.h"

namespace vfit {
namespace {

using namespace test;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

MeshQuery query(const Mesh& mesh) { return MeshQuery(mesh.positions, mesh.indices); }

Vec3 random_point(std::mt19937& random, float reach) {
    std::uniform_real_distribution<float> uniform(-reach, reach);
    const float x = uniform(random), y = uniform(random), z = uniform(random);
    return {x, y, z};
}

vfit_result error_of(const std::vector<Vec3>& positions, const std::vector<uint32_t>& indices) {
    try {
        MeshQuery q(positions, indices);
    } catch (const Error& error) {
        return error.code();
    }
    return VFIT_OK;
}

TEST(MeshQuery, DistanceToASphereIsTheAnalyticOne) {
    // Flat triangles lie inside the sphere by at most the sagitta of the longest edge: 0.5 (pi / 100)^2 / 2.
    const MeshQuery sphere = query(ellipsoid(Vec3(0.5f), 100, 200));
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = random_point(random, 1.0f);
        const float expected = glm::length(p) - 0.5f;
        EXPECT_NEAR(sphere.signed_distance(p), expected, 3e-4f);
        const MeshQuery::Closest c = sphere.closest(p);
        EXPECT_NEAR(c.distance, std::abs(expected), 3e-4f);
        EXPECT_NEAR(glm::distance(c.point, p), c.distance, 1e-6f);
        EXPECT_GT(glm::dot(c.normal, c.point), 0.49f);  // outwards
    }
}

TEST(MeshQuery, ClosestPointIsTheBestOfAllTriangles) {
    const Mesh mesh = torus(0.3f, 0.1f, 12, 20);
    const MeshQuery q = query(mesh);
    std::mt19937 random(2);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random_point(random, 0.6f);
        float best = kInfinity;
        for (size_t t = 0; t < mesh.indices.size(); t += 3) {
            const TriangleCorners corners{mesh.positions[mesh.indices[t]],
                                          mesh.positions[mesh.indices[t + 1]],
                                          mesh.positions[mesh.indices[t + 2]]};
            best = std::min(best, glm::distance(closest_point(corners, p).position, p));
        }
        const MeshQuery::Closest c = q.closest(p);
        EXPECT_NEAR(c.distance, best, 1e-7f);
        const uint32_t* corner = &mesh.indices[3 * c.triangle];
        const Vec3 named = (1.0f - c.uv.x - c.uv.y) * mesh.positions[corner[0]] +
                           c.uv.x * mesh.positions[corner[1]] + c.uv.y * mesh.positions[corner[2]];
        EXPECT_LT(glm::distance(named, c.point), 1e-6f);
    }
}

TEST(MeshQuery, ClosestPointOfATriangleHasNoBetterNeighbour) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (int i = 0; i < 300; ++i) {
        TriangleCorners t{random_point(random, 1.0f), random_point(random, 1.0f), random_point(random, 1.0f)};
        if (i % 3 == 1) t.c = t.a + 0.5f * (t.b - t.a);  // a line
        if (i % 30 == 2) t.b = t.c = t.a;                // a point
        const Vec3 p = random_point(random, 2.0f);
        const float distance = glm::distance(closest_point(t, p).position, p);
        for (int k = 0; k < 200; ++k) {
            float v = unit(random), w = unit(random);
            if (v + w > 1.0f) v = 1.0f - v, w = 1.0f - w;
            EXPECT_LE(distance, glm::distance(t.a + v * (t.b - t.a) + w * (t.c - t.a), p) + 1e-5f);
        }
    }
}

TEST(MeshQuery, OfTrianglesThatTieTheFirstIsNamed) {
    // Queries at the corners themselves: about six triangles lie equally far.
    const MeshQuery q = query(ellipsoid(Vec3(0.5f), 10, 20));
    for (const Vec3& corner : q.positions()) {
        float best = kInfinity;
        uint32_t first = 0;
        for (uint32_t t = 0; t < q.indices().size() / 3; ++t) {
            const uint32_t* v = &q.indices()[3 * t];
            const Vec3 offset =
                closest_point({q.positions()[v[0]], q.positions()[v[1]], q.positions()[v[2]]}, corner)
                    .position -
                corner;
            if (glm::dot(offset, offset) < best) best = glm::dot(offset, offset), first = t;
        }
        EXPECT_EQ(q.closest(corner).triangle, first);
    }
}

TEST(MeshQuery, InsideOfATorusIsTheTubeAndNotTheHole) {
    const MeshQuery q = query(torus(0.3f, 0.1f, 64, 128));
    EXPECT_FALSE(q.inside(Vec3(0.0f)));
    EXPECT_TRUE(q.inside(Vec3(0.3f, 0.0f, 0.0f)));
    EXPECT_NEAR(q.closest(Vec3(0.0f)).distance, 0.2f, 5e-4f);
    std::mt19937 random(4);
    for (int i = 0; i < 5000; ++i) {
        const Vec3 p = random_point(random, 0.45f);
        const float to_ring = std::hypot(std::hypot(p.x, p.z) - 0.3f, p.y) - 0.1f;
        if (std::abs(to_ring) > 1e-3f) {
            EXPECT_EQ(q.inside(p), to_ring < 0.0f) << p.x << ' ' << p.y << ' ' << p.z;
        }
    }
}

TEST(MeshQuery, InsideHoldsForPointsInLineWithVerticesAndEdges) {
    // A cube of two triangles a face: rays from its middle planes run along edges and through corners.
    Mesh cube = grid(1, 4, false, [](float r, float c) {
        const float a = 2.0f * kPi * (c + 0.125f);
        return Vec3(std::cos(a), r, std::sin(a));
    });
    close_ends(cube, 4);
    const MeshQuery q = query(cube);
    for (float x = -0.9f; x < 1.0f; x += 0.1f)
        for (float z = -0.9f; z < 1.0f; z += 0.1f)
            for (const float y : {-0.5f, 0.25f, 0.5f, 1.5f}) {
                const bool inside =
                    y > 0.0f && y < 1.0f && std::max(std::abs(x), std::abs(z)) < std::sqrt(0.5f);
                EXPECT_EQ(q.inside({x, y, z}), inside) << x << ' ' << y << ' ' << z;
            }
}

TEST(MeshQuery, WhereTwoSkinsOverlapIsInside) {
    Mesh mesh = ellipsoid(Vec3(0.5f), 20, 40);
    const Mesh other = mesh;
    const auto offset = static_cast<uint32_t>(mesh.positions.size());
    for (const Vec3& p : other.positions) mesh.positions.push_back(p + Vec3(0.5f, 0, 0));
    for (const uint32_t i : other.indices) mesh.indices.push_back(i + offset);
    const MeshQuery q = query(mesh);
    EXPECT_TRUE(q.inside({0.25f, 0.01f, 0.02f}));
    EXPECT_TRUE(q.inside({-0.25f, 0.01f, 0.02f}));
    EXPECT_TRUE(q.inside({0.75f, 0.01f, 0.02f}));
    EXPECT_FALSE(q.inside({1.25f, 0.01f, 0.02f}));
}

TEST(MeshQuery, RaysReportTheFirstTriangleInMetres) {
    const MeshQuery q = query(ellipsoid(Vec3(0.5f), 100, 200));
    const auto hit = q.cast({-2.0f, 0.01f, 0.0f}, {10.0f, 0.0f, 0.0f}, 5.0f);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->distance, 1.5f, 5e-4f);
    EXPECT_NEAR(hit->normal.x, -1.0f, 0.05f);
    EXPECT_FALSE(q.cast({-2.0f, 0.01f, 0.0f}, {1, 0, 0}, 1.4f).has_value());
    EXPECT_FALSE(q.cast({-2.0f, 0.01f, 0.0f}, {-1, 0, 0}, kInfinity).has_value());
    EXPECT_FALSE(q.cast({-2.0f, 0.01f, 0.0f}, {0, 0, 0}, kInfinity).has_value());
}

TEST(MeshQuery, LargestInnerSphereInACylinderIsItsRadius) {
    const MeshQuery q = query(cylinder(0.2f, 2.0f, 40, 180));
    EXPECT_NEAR(largest_inner_sphere(q, {0, 1, 0}), 0.2f, 1e-4f);
    EXPECT_NEAR(largest_inner_sphere(q, {0.05f, 1, 0}), 0.15f, 1e-4f);
    EXPECT_NEAR(largest_inner_sphere(q, {0, 1.9f, 0}), 0.1f, 1e-5f);  // the lid is nearer
    EXPECT_EQ(largest_inner_sphere(q, {0.3f, 1, 0}), 0.0f);
}

TEST(MeshQuery, FollowsTheMeshWhenItMoves) {
    Mesh mesh = ellipsoid(Vec3(0.5f), 40, 80);
    MeshQuery q = query(mesh);
    for (int step = 1; step <= 3; ++step) {
        const Vec3 shift(0.4f * float(step), 0, 0);
        std::vector<Vec3> moved;
        for (const Vec3& p : mesh.positions) moved.push_back(p * (1.0f + 0.2f * float(step)) + shift);
        q.update(moved);
        const float radius = 0.5f * (1.0f + 0.2f * float(step));
        EXPECT_NEAR(q.closest(shift).distance, radius, 2e-3f);
        EXPECT_NEAR(q.signed_distance(shift + Vec3(0, 2, 0)), 2.0f - radius, 2e-3f);
        EXPECT_NEAR(q.cast(shift, {0, 0, 1}, 5.0f)->distance, radius, 2e-3f);
        EXPECT_FALSE(q.inside(shift - Vec3(radius + 0.01f, 0, 0)));
    }
    EXPECT_THROW(q.update(std::vector<Vec3>(3)), Error);
    std::vector<Vec3> broken = mesh.positions;
    broken[7].y = std::nanf("");
    const Vec3 kept = q.positions()[0];
    EXPECT_THROW(q.update(broken), Error);
    EXPECT_EQ(q.positions()[0], kept);
}

TEST(MeshQuery, SurvivesBeingMoved) {
    MeshQuery a = query(ellipsoid(Vec3(0.5f), 20, 40));
    const MeshQuery b = std::move(a);
    EXPECT_NEAR(b.closest(Vec3(0.0f)).distance, 0.5f, 1e-2f);
}

#ifdef __linux__
TEST(MeshQuery, StartsNoThreads) {
    const auto threads = [] {
        const std::filesystem::directory_iterator tasks("/proc/self/task");
        return std::distance(begin(tasks), end(tasks));
    };
    const auto before = threads();
    MeshQuery q = query(ellipsoid(Vec3(0.5f), 200, 400));  // 160,000 triangles are enough work to share
    q.update(q.positions());
    EXPECT_EQ(threads(), before);
}
#endif

TEST(MeshQuery, RefusesBrokenMeshes) {
    const std::vector<Vec3> good = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(error_of(good, {0, 1, 2}), VFIT_OK);
    EXPECT_EQ(error_of({}, {}), VFIT_ERROR_DATA);
    EXPECT_EQ(error_of(good, {}), VFIT_ERROR_DATA);
    EXPECT_EQ(error_of(good, {0, 1}), VFIT_ERROR_DATA);
    EXPECT_EQ(error_of(good, {0, 1, 3}), VFIT_ERROR_DATA);
    EXPECT_EQ(error_of({{0, 0, 0}, {1, 0, 0}, {0, kInfinity, 0}}, {0, 1, 2}), VFIT_ERROR_DATA);
}

}  // namespace
}  // namespace vfit
