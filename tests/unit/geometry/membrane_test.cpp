// Shifts that are evened out over a mesh.
#include "geometry/membrane.h"

#include <gtest/gtest.h>

namespace vfit {
namespace {

/// A strip of squares along X, two triangles each; vertex 2 i + k stands at (i, k).
std::vector<uint32_t> strip(uint32_t squares) {
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < squares; ++i) {
        const uint32_t a = 2 * i;
        indices.insert(indices.end(), {a, a + 2, a + 1, a + 1, a + 2, a + 3});
    }
    return indices;
}

TEST(Membrane, GoesEvenlyFromWhatIsHeldToWhatIsHeld) {
    constexpr uint32_t kSquares = 10;
    constexpr float kDiagonals = 0.04f;  // edges that do not run along X make the way a little uneven
    const Membrane membrane(2 * kSquares + 2, strip(kSquares));
    std::vector<Vec3> wanted(2 * kSquares + 2, Vec3(0.0f));
    std::vector<float> weights(wanted.size(), 0.0f);
    for (const size_t v : {0u, 1u}) weights[v] = 1e6f;
    for (const size_t v : {2 * kSquares, 2 * kSquares + 1}) wanted[v] = Vec3(1, 0, 0), weights[v] = 1e6f;
    const std::vector<Vec3> even = membrane.even(wanted, weights, 1.0f, 300);
    for (uint32_t i = 0; i <= kSquares; ++i)
        for (uint32_t k = 0; k < 2; ++k)
            EXPECT_NEAR(even[2 * i + k].x, float(i) / float(kSquares), kDiagonals) << i << " " << k;
}

TEST(Membrane, WhatIsTheSameEverywhereStays) {
    const Membrane membrane(8, strip(3));
    const std::vector<Vec3> wanted(8, Vec3(0.1f, -0.2f, 0.3f));
    const std::vector<Vec3> even = membrane.even(wanted, std::vector<float>(8, 0.5f), 2.0f, 50);
    for (const Vec3& shift : even) EXPECT_LT(glm::distance(shift, wanted[0]), 1e-6f);
}

TEST(Membrane, AVertexOfNoTriangleKeepsWhatItWants) {
    const Membrane membrane(9, strip(3));
    std::vector<Vec3> wanted(9, Vec3(0.0f));
    wanted[8] = Vec3(1, 2, 3);
    EXPECT_TRUE(membrane.neighbours(8).empty());
    EXPECT_EQ(membrane.even(wanted, std::vector<float>(9, 0.0f), 1.0f, 5)[8], Vec3(1, 2, 3));
}

}  // namespace
}  // namespace vfit
