// Triangles by their place along a direction: none that a plane cuts is missing.
#include "geometry/triangle_layers.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>

#include "core/error.h"
#include "unit/geometry/mesh_shapes.h"

namespace vfit {
namespace {

using namespace test;

TEST(TriangleLayers, HoldEveryTriangleThatAPlaneCuts) {
    const Mesh mesh = ellipsoid({0.3f, 0.5f, 0.4f}, 60, 60);
    const Vec3 leaning = glm::normalize(Vec3(0.3f, -0.8f, 0.5f)), far_off(100, -50, 30);
    for (const auto& [origin, direction] :
         {std::pair(Vec3(0.0f), Vec3(0, 1, 0)), {Vec3(0.0f), leaning}, {far_off, leaning}}) {
        std::vector<Vec3> positions = mesh.positions;
        for (Vec3& p : positions) p += origin;
        const float low = -0.2f, high = 0.25f;
        const TriangleLayers layers(positions, mesh.indices, origin, direction, low, high);
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
                    const float corner = glm::dot(direction, positions[mesh.indices[t + k]] - origin);
                    least = std::min(least, corner), most = std::max(most, corner);
                }
                if (least <= place && place <= most) {
                    EXPECT_TRUE(found.count({mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]}))
                        << place;
                }
            }
        }
        EXPECT_LT(held / 451, mesh.indices.size() / 3 / 4) << "few others";
    }
}

TEST(TriangleLayers, HoldNothingOfWhatLiesElsewhere) {
    const Mesh mesh = ellipsoid(Vec3(0.3f), 12, 12);
    const TriangleLayers above(mesh.positions, mesh.indices, Vec3(0.0f), {0, 1, 0}, 0.5f, 0.6f);
    for (const float place : {0.5f, 0.55f, 9.0f, -9.0f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_TRUE(above.at(place).empty()) << place;
    const TriangleLayers none({}, {}, Vec3(0.0f), {0, 1, 0}, 0.0f, 0.0f);
    EXPECT_TRUE(none.at(0.0f).empty());
}

TEST(TriangleLayers, TakePlacesBeyondTheEndsForTheEnds) {
    const Mesh mesh = ellipsoid(Vec3(0.3f), 12, 12);
    const TriangleLayers layers(mesh.positions, mesh.indices, Vec3(0.0f), {0, 1, 0}, -0.1f, 0.1f);
    const auto same = [](std::span<const uint32_t> a, std::span<const uint32_t> b) {
        return a.data() == b.data() && a.size() == b.size();
    };
    EXPECT_FALSE(layers.at(0.0f).empty());
    EXPECT_FALSE(same(layers.at(-0.1f), layers.at(0.1f)));
    for (const float beyond : {-1.0f, -1e30f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_TRUE(same(layers.at(beyond), layers.at(-0.1f))) << beyond;
    for (const float beyond : {1.0f, 1e30f}) EXPECT_TRUE(same(layers.at(beyond), layers.at(0.1f))) << beyond;
    // Turned round there is one layer, and a mesh in millimetres has no more layers than one in metres.
    const TriangleLayers round(mesh.positions, mesh.indices, Vec3(0.0f), {0, 1, 0}, 0.1f, -0.1f);
    EXPECT_TRUE(same(round.at(-1.0f), round.at(1.0f)));
    std::vector<Vec3> huge = mesh.positions;
    for (Vec3& p : huge) p *= 1e6f;
    const TriangleLayers wide(huge, mesh.indices, Vec3(0.0f), {0, 1, 0}, -3e5f, 3e5f);
    EXPECT_FALSE(wide.at(0.0f).empty());
    EXPECT_LT(wide.at(0.0f).size(), mesh.indices.size());
    EXPECT_THROW(TriangleLayers(huge, mesh.indices, Vec3(0.0f), {0, 1, 0}, -3e38f, 3e38f), Error);
}

}  // namespace
}  // namespace vfit
