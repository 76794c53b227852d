// The collision proxy of the skin.
#include <gtest/gtest.h>

#include <cmath>

#include "outfit/wrapped_skin.h"
#include "unit/cloth/tube.h"

namespace vfit {
namespace {

using test::Tube;

TEST(WrappedSkin, SkinIsRaisedAroundABumpAndNeverLowered) {
    // A plate of 5 mm squares with a bump of one vertex, closed below.
    constexpr uint32_t kSide = 21;
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    for (const float y : {0.0f, -0.05f})
        for (uint32_t r = 0; r < kSide; ++r)
            for (uint32_t c = 0; c < kSide; ++c)
                positions.emplace_back(0.005f * float(c), y, 0.005f * float(r));
    const uint32_t bump = kSide * (kSide / 2) + kSide / 2;
    positions[bump].y = 0.01f;
    for (uint32_t r = 0; r + 1 < kSide; ++r)
        for (uint32_t c = 0; c + 1 < kSide; ++c) {
            const uint32_t a = r * kSide + c, b = a + 1, d = a + kSide, e = d + 1, below = kSide * kSide;
            indices.insert(indices.end(), {a, d, b, b, d, e, below + a, below + b, below + d, below + b,
                                           below + e, below + d});
        }
    const std::vector<Vec3> wrapped = wrapped_skin(positions, indices);
    for (uint32_t v = 0; v < kSide * kSide; ++v) EXPECT_GE(wrapped[v].y, positions[v].y - 1e-6f) << v;
    EXPECT_GT(wrapped[bump + 1].y, 0.002f);
    EXPECT_LT(wrapped[bump + 8].y, 0.002f);  // 4 cm away it is as it was, except for rounding
}

/// By how much the bottom of a groove in the middle of a block of 20 cm is raised.
float raised_in_groove(float half_width_m, float depth_m) {
    constexpr uint32_t kSide = 41;
    constexpr float kStep_m = 0.005f;
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    for (const float y : {0.0f, -0.1f})
        for (uint32_t r = 0; r < kSide; ++r)
            for (uint32_t c = 0; c < kSide; ++c) {
                const float x = kStep_m * float(c), aside = std::abs(x - 0.1f);
                const float groove = depth_m * std::min(0.0f, aside / half_width_m - 1.0f);
                positions.emplace_back(x, y == 0.0f ? groove : y, kStep_m * float(r));
            }
    for (uint32_t r = 0; r + 1 < kSide; ++r)
        for (uint32_t c = 0; c + 1 < kSide; ++c) {
            const uint32_t a = r * kSide + c, b = a + 1, d = a + kSide, e = d + 1, below = kSide * kSide;
            indices.insert(indices.end(), {a, d, b, b, d, e, below + a, below + b, below + d, below + b,
                                           below + e, below + d});
        }
    const uint32_t bottom = kSide * (kSide / 2) + kSide / 2;
    EXPECT_NEAR(positions[bottom].y, -depth_m, 1e-6f);
    return wrapped_skin(positions, indices)[bottom].y - positions[bottom].y;
}

TEST(WrappedSkin, ADeepHollowOfTheSkinIsNotFilledUp) {
    // Straps lie in the groove: three quarters of its depth stay.
    for (const float depth_m : {0.03f, 0.06f}) {
        EXPECT_GT(raised_in_groove(0.02f, depth_m), 0.002f) << depth_m;
        EXPECT_LT(raised_in_groove(0.02f, depth_m), 0.25f * depth_m) << depth_m;
    }
    // An edge of cloth spans a groove that is narrower than the edge is long.
    EXPECT_GT(raised_in_groove(0.01f, 0.004f), 0.5f * 0.004f);
    EXPECT_LE(raised_in_groove(0.01f, 0.004f), 0.004f);
}

TEST(WrappedSkin, AnEdgeOfClothOnARoundLimbStaysOutOfTheSkin) {
    constexpr float kEdge_m = 0.022f;
    for (const float radius_m : {0.027f, 0.05f, 0.15f}) {  // wrist, upper arm, thorax
        const Tube limb(radius_m, 0.2f, 96, 40, 1.0f);
        const uint32_t middle = 20 * 96;
        const Vec3 on = wrapped_skin(limb.positions, limb.indices)[middle];
        const float proxy_m = std::hypot(on.x, on.z);
        // Both ends on the proxy, the edge's middle is nearest to the axis.
        EXPECT_GE(std::sqrt(proxy_m * proxy_m - 0.25f * kEdge_m * kEdge_m), radius_m) << radius_m;
        const float sagitta_m = radius_m - std::sqrt(radius_m * radius_m - 0.25f * kEdge_m * kEdge_m);
        EXPECT_LT(proxy_m - radius_m, 1.2f * sagitta_m) << "no further off than the edge needs";
    }
}

}  // namespace
}  // namespace vfit
