// Triangles by their place along a direction: none that a plane cuts is missing.
#include "measure/triangle_layers.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>

#include "unit/measure/mesh_shapes.h"

namespace vfit {
namespace {

using namespace test;

TEST(TriangleLayers, HoldEveryTriangleThatAPlaneCuts) {
    const Mesh mesh = ellipsoid({0.3f, 0.5f, 0.4f}, 60, 60);
    for (const Vec3& direction : {Vec3(0, 1, 0), glm::normalize(Vec3(0.3f, -0.8f, 0.5f))}) {
        const float low = -0.2f, high = 0.25f;
        const TriangleLayers layers(mesh.positions, mesh.indices, direction, low, high);
        size_t held = 0;
        for (int i = 0; i <= 450; ++i) {
            const float place = i == 450 ? high : low + 0.001f * float(i);
            const std::span<const uint32_t> at = layers.at(place);
            ASSERT_EQ(at.size() % 3, 0u);
            std::set<std::array<uint32_t, 3>> found;
            for (size_t t = 0; t < at.size(); t += 3) found.insert({at[t], at[t + 1], at[t + 2]});
            held += found.size();
            for (size_t t = 0; t < mesh.indices.size(); t += 3) {
                float least = 1e9f, most = -1e9f;
                for (size_t k = 0; k < 3; ++k) {
                    const float corner = glm::dot(direction, mesh.positions[mesh.indices[t + k]]);
                    least = std::min(least, corner), most = std::max(most, corner);
                }
                if (least <= place && place <= most) {
                    EXPECT_TRUE(found.count({mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]})) << place;
                }
            }
        }
        EXPECT_LT(held / 451, mesh.indices.size() / 3 / 4) << "few others";
    }
}

TEST(TriangleLayers, HoldNothingOfWhatLiesElsewhere) {
    const Mesh mesh = ellipsoid(Vec3(0.3f), 12, 12);
    const TriangleLayers above(mesh.positions, mesh.indices, {0, 1, 0}, 0.5f, 0.6f);
    for (const float place : {0.5f, 0.55f, 9.0f, -9.0f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_TRUE(above.at(place).empty()) << place;
    const TriangleLayers none({}, {}, {0, 1, 0}, 0.0f, 0.0f);
    EXPECT_TRUE(none.at(0.0f).empty());
}

}  // namespace
}  // namespace vfit
