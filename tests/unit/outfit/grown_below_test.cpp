// A garment that grows below another: from a part of its width outwards, with a curtain below the hem and
// none at the upper border.
#include "outfit/grown_below.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/cloth/post.h"

namespace vfit {
namespace {

using namespace test;

TEST(GrownBelow, GrowsWithACurtainBelowItsHemAlone) {
    const Garment g = sleeve(0.12f);  // from 0.3 to 0.7 m about the Y axis
    GrownBelow grown(g.vertex_count(), g.mesh.indices);
    std::vector<Vec3> within, places;
    for (const Vec3& p : g.mesh.positions) within.emplace_back(0.0f, p.y, 0.0f);
    for (const float share : {0.0f, 0.5f, 1.0f}) {
        grown.place(g.mesh.positions, within, share, places);
        ASSERT_EQ(places.size(), grown.vertex_count());
        const float radius = 0.12f * (0.3f + 0.7f * share);
        size_t below = 0, nowhere = 0;
        for (size_t v = 0; v < places.size(); ++v) {
            const Vec3& p = places[v];
            if (!std::isfinite(p.x)) {
                ++nowhere;
                continue;
            }
            ASSERT_NEAR(std::hypot(p.x, p.z), radius, 1e-5f);
            if (v < g.vertex_count()) {
                ASSERT_NEAR(p.y, g.mesh.positions[v].y, 1e-6f);
                continue;
            }
            ASSERT_LT(p.y, 0.3f) << "a curtain hangs below the hem";
            ++below;
        }
        EXPECT_EQ(below, nowhere) << "two borders, one of which points down";
        EXPECT_GT(below, 5 * kRound);
    }
    // All triangles of the curtain face outwards, as those of the garment do.
    for (size_t i = 0; i < grown.indices().size(); i += 3) {
        const Vec3 &a = places[grown.indices()[i]], &b = places[grown.indices()[i + 1]],
                   &c = places[grown.indices()[i + 2]];
        if (!std::isfinite(a.x + b.x + c.x)) continue;
        const Vec3 out = glm::cross(b - a, c - a), middle = (a + b + c) / 3.0f;
        ASSERT_GT(out.x * middle.x + out.z * middle.z, 0.0f) << i;
    }
}

}  // namespace
}  // namespace vfit
