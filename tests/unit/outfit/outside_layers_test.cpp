// Garments moved past others at once, on tubes about a bone.
#include <gtest/gtest.h>

#include <cmath>

#include "cloth/crossings.h"
#include "outfit/outside_layers.h"
#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;

/// About the y axis, from y = 0 down; the radius changes with the height, and with the angle in waves.
struct Tube {
    static constexpr uint32_t kAround = 48, kRows = 25;
    std::vector<Vec3> positions, on_bones;
    std::vector<uint32_t> indices;

    template <typename Radius>
    Tube(float length_m, const Radius& radius_m) {
        for (uint32_t r = 0; r < kRows; ++r)
            for (uint32_t a = 0; a < kAround; ++a) {
                const float y = -length_m * float(r) / float(kRows - 1),
                            angle = 2.0f * kPi * float(a) / float(kAround), radius = radius_m(y, angle);
                positions.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
                on_bones.emplace_back(0.0f, y, 0.0f);
                if (r + 1 == kRows) continue;
                const uint32_t next = r * kAround + (a + 1) % kAround, here = r * kAround + a;
                indices.insert(indices.end(), {here, next, here + kAround});
                indices.insert(indices.end(), {next, next + kAround, here + kAround});
            }
    }
    AboutBones about_bones() const { return {positions, indices, on_bones}; }
};

size_t crossed(const Tube& inner, const Tube& outer, const std::vector<Vec3>& places) {
    return crossed_triangles({places, outer.indices}, {inner.positions, inner.indices}).size();
}

TEST(OutsideLayers, ANarrowGarmentGoesPastAWideOneAndItsHem) {
    const Tube skirt(0.5f,
                     [](float y, float angle) { return 0.12f - 0.25f * y + 0.02f * std::sin(8 * angle); });
    const Tube coat(0.7f, [](float, float) { return 0.15f; });
    ASSERT_GT(crossed(skirt, coat, coat.positions), 0u);
    const AboutBones inner = skirt.about_bones();
    const std::vector<Vec3> outside = outside_of({&inner, 1}, coat.about_bones(), 0.008f);
    EXPECT_EQ(crossed(skirt, coat, outside), 0u);
    for (size_t v = 0; v < outside.size(); ++v) {
        const Vec3& p = outside[v];
        EXPECT_FLOAT_EQ(p.y, coat.positions[v].y);
        EXPECT_GE(std::hypot(p.x, p.z), 0.1499f) << "inwards";
        if (p.y > -0.5f) {
            EXPECT_GT(std::hypot(p.x, p.z), 0.10f - 0.25f * p.y) << "inside of the skirt";
        }
    }
}

TEST(OutsideLayers, WhatIsClearStaysAndWhatBelongsToAnotherLimbDoesNotCount) {
    const Tube trunk(0.5f, [](float, float) { return 0.15f; });
    Tube sleeve(0.5f, [](float, float) { return 0.05f; });
    for (Vec3& p : sleeve.positions) p.x += 0.22f;
    for (Vec3& p : sleeve.on_bones) p.x += 0.22f;
    const AboutBones inner = trunk.about_bones();
    EXPECT_EQ(outside_of({&inner, 1}, sleeve.about_bones(), 0.008f), sleeve.positions);
}

}  // namespace
}  // namespace vfit
