// The convex surface around a hand.
#include "outfit/mitten.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/mesh_query.h"

namespace vfit {
namespace {

/// Four fingers along +X and a thumb, of points; the forearm lies at -X.
std::vector<Vec3> hand() {
    std::vector<Vec3> out;
    for (int finger = 0; finger < 5; ++finger) {
        const float turn = finger == 4 ? 1.0f : 0.1f * float(finger - 2);
        const Vec3 along(std::cos(turn), 0.0f, std::sin(turn));
        for (int i = 0; i < 40; ++i)
            for (const float y : {-0.01f, 0.01f}) out.push_back(Vec3(0, y, 0) + along * (0.004f * float(i)));
    }
    return out;
}

Vec3 normal_of(const Mitten& m, size_t i) {
    const Vec3 &a = m.places[m.indices[i]], &b = m.places[m.indices[i + 1]], &c = m.places[m.indices[i + 2]];
    return glm::normalize(glm::cross(b - a, c - a));
}

TEST(Mitten, HoldsTheHand) {
    constexpr float kCut_m = 0.01f;  // by chords between the corners of a section
    const std::vector<Vec3> points = hand();
    const Mitten mitten = mitten_around(points, {-1, 0, 0});
    const MeshQuery surface(mitten.places, mitten.indices);
    for (const Vec3& p : points)
        EXPECT_TRUE(p.x < 0.01f || surface.signed_distance(p) < kCut_m)
            << p.x << " " << p.z << " " << surface.signed_distance(p);
    for (const Vec3& p : mitten.places) {
        float nearest = INFINITY;
        for (const Vec3& q : points) nearest = std::min(nearest, glm::distance(p, q));
        EXPECT_LT(nearest, 0.08f) << "it lies close, except in the gap beside the thumb";
    }
}

TEST(Mitten, ItsSectionsAreConvex) {
    const Mitten mitten = mitten_around(hand(), {-1, 0, 0});
    constexpr size_t kRound = 24;
    ASSERT_EQ(mitten.places.size() % kRound, 1u);
    for (size_t first = 0; first + kRound < mitten.places.size(); first += kRound)
        for (size_t k = 0; k < kRound; ++k) {
            const Vec3 &a = mitten.places[first + k], &b = mitten.places[first + (k + 1) % kRound],
                       &c = mitten.places[first + (k + 2) % kRound];
            EXPECT_GT(glm::cross(b - a, c - b).x, -1e-6f) << first << " " << k;
        }
}

TEST(Mitten, IsOpenTowardsTheForearm) {
    const Mitten mitten = mitten_around(hand(), {-1, 0, 0});
    for (size_t i = 0; i < mitten.indices.size(); i += 3) EXPECT_GT(normal_of(mitten, i).x, -0.95f);
}

TEST(Mitten, GoesWithTheNearestOfTheHand) {
    const std::vector<Vec3> points = hand();
    const Mitten mitten = mitten_around(points, {-1, 0, 0});
    ASSERT_EQ(mitten.goes_with.size(), mitten.places.size());
    for (size_t i = 0; i < mitten.places.size(); ++i)
        for (const Vec3& p : points)
            ASSERT_LE(glm::distance(points[mitten.goes_with[i]], mitten.places[i]),
                      glm::distance(p, mitten.places[i]) + 1e-6f);
}

TEST(Mitten, OfNoPointsOrOfPointsInOnePlaneIsFinite) {
    EXPECT_TRUE(mitten_around({}, {-1, 0, 0}).places.empty());
    std::vector<Vec3> flat = hand();
    for (Vec3& p : flat) p.y = 0.0f;
    for (const std::vector<Vec3>& points : {flat, {Vec3(1.0f)}, {Vec3(0.0f), Vec3(0.1f)}})
        for (const Vec3& p : mitten_around(points, {-1, 0, 0}).places)
            EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
}

}  // namespace
}  // namespace vfit
