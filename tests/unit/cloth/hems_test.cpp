// Hems at the ends of limbs: found, kept there, taken up.
#include <gtest/gtest.h>

#include <cmath>

#include "cloth/garment/hems.h"
#include "tube.h"

namespace vfit {
namespace {

using test::Tube;

TEST(Hems, HemsAreTheBordersAtTheEndsOfLimbs) {
    const Tube tube(0.05f, 0.4f, 12, 10, 1.0f);
    std::vector<BodyPart> below(tube.positions.size(), BodyPart::kLeftUpperArm);
    for (uint32_t v = 0; v < 24; ++v) below[v] = BodyPart::kLeftForearm;
    std::vector<uint8_t> simulated(tube.positions.size(), 1);
    for (uint32_t v = 120; v < 132; ++v) simulated[v] = 0;
    const auto hems = limb_hems(tube.indices, below, simulated, tube.positions);
    ASSERT_EQ(hems.size(), 1u);
    EXPECT_TRUE(hems[0].of_arm);
    EXPECT_EQ(hems[0].vertices.size(), 12u);
    for (const uint32_t v : hems[0].vertices) EXPECT_LT(v, 12u);
    EXPECT_NEAR(hems[0].way_m, 0.4f, 0.01f);
}

/// A sleeve that hangs on its upper border, on a limb that is shorter by some share.
struct Sleeve {
    Tube tube;
    std::vector<uint8_t> simulated = std::vector<uint8_t>(tube.positions.size(), 1);
    std::vector<LimbHem> hems;

    explicit Sleeve(float limb, float radius_m = 0.05f) : tube(radius_m, 0.4f, 12, 10, 1.0f) {
        for (uint32_t v = 120; v < 132; ++v) simulated[v] = 0;
        std::vector<Vec3> carried = tube.positions;
        for (Vec3& p : carried) p.y *= limb;
        hems = limb_hems(tube.indices, std::vector<BodyPart>(tube.positions.size(), BodyPart::kLeftForearm),
                         simulated, carried);
        std::erase_if(hems, [&](const LimbHem& hem) { return hem.vertices[0] >= 12; });
    }
    FabricData fabric(const std::vector<Vec2>& cut) const {
        return cook_fabric({tube.positions, tube.indices, {}, simulated, 1.0f, cut},
                           {0.2f, 1000.0f, 1000.0f, 50.0f, 2e-5f, 0.3f});
    }
};

TEST(Hems, HemsAreKeptWhereTheClothIsLongerThanTheLimb) {
    for (const float limb : {1.0f, 0.9f}) {
        const Sleeve sleeve(limb);
        FabricData fabric = sleeve.fabric(sleeve.tube.cut);
        keep_hems(sleeve.hems, fabric.tethers, fabric);
        EXPECT_EQ(fabric.limits.size(), limb < 1.0f ? 12u : 0u);
    }
}

TEST(Hems, AHemRidesUpButDoesNotSlideOff) {
    for (const float radius_m : {0.03f, 0.05f, 0.13f, 0.3f}) {
        const Sleeve sleeve(0.9f, radius_m);  // down the Y axis
        FabricData fabric = sleeve.fabric(sleeve.tube.cut);
        keep_hems(sleeve.hems, fabric.tethers, fabric);
        ASSERT_EQ(fabric.limits.size(), 12u) << radius_m;
        for (const DistanceLimit& limit : fabric.limits) {
            const auto carried = [&](uint32_t v) {
                return Vec3(1.0f, 0.9f, 1.0f) * sleeve.tube.positions[v];
            };
            const Vec3 hem = carried(limit.vertex), from = carried(limit.target);
            const auto may_be_at = [&](float up_m) {
                return glm::distance(hem + Vec3(0.0f, up_m, 0.0f), from) <= limit.distance_m;
            };
            EXPECT_NEAR(from.y - hem.y, 0.1f, 0.03f) << radius_m;
            EXPECT_TRUE(may_be_at(0.15f)) << radius_m;
            EXPECT_TRUE(may_be_at(-0.015f)) << radius_m;
            EXPECT_FALSE(may_be_at(-0.03f)) << radius_m;
        }
    }
}

TEST(Hems, AHemOfAShortSleeveStaysNearItsPlace) {
    const Tube tube(0.05f, 0.06f, 12, 3, 1.0f);
    std::vector<uint8_t> simulated(tube.positions.size(), 1);
    for (uint32_t v = 36; v < 48; ++v) simulated[v] = 0;
    const auto hems =
        limb_hems(tube.indices, std::vector<BodyPart>(tube.positions.size(), BodyPart::kLeftForearm),
                  simulated, tube.positions);
    ASSERT_FALSE(hems.empty());
    for (const LimbHem& hem : hems)
        for (size_t i = 0; i < hem.vertices.size(); ++i) {
            EXPECT_EQ(hem.up[i].vertex, hem.vertices[i]);
            EXPECT_EQ(hem.up[i].distance_m, 0.0f);
        }
}

TEST(Hems, ASleeveOnTheHandEndsAtTheWrist) {
    const Sleeve sleeve(1.0f);  // down the Y axis, its hem at 0
    constexpr float kWrist_m = 0.03f;
    Tube limb{0.03f, 0.5f, 12, 50, 1.0f};
    std::vector<BodyPart> parts;
    for (Vec3& p : limb.positions) {
        p.y -= 0.1f;
        parts.push_back(p.y < kWrist_m ? BodyPart::kLeftHand : BodyPart::kLeftForearm);
    }
    std::vector<Vec3> carried = sleeve.tube.positions;
    for (auto* of : {&carried, &limb.positions})
        for (Vec3& p : *of) p.x += 0.3f;  // the left arm
    const BoundBody body{limb.positions, limb.indices, {}, {}, parts};
    std::vector<LimbHem> hems = sleeve.hems;
    const float way_m = hems.at(0).way_m;
    end_at_wrists(hems, body, carried);
    EXPECT_NEAR(hems[0].past_wrist_m, kWrist_m, 0.006f);
    std::vector<Vec2> cut = sleeve.tube.cut;
    EXPECT_NEAR(take_up(hems, sleeve.tube.indices, sleeve.simulated, cut).sleeves_m, kWrist_m, 0.01f);
    FabricData fabric = sleeve.fabric(sleeve.tube.cut);
    keep_hems(hems, fabric.tethers, fabric);
    ASSERT_EQ(fabric.limits.size(), 12u);
    const float beyond_m = fabric.limits[0].distance_m - hems[0].up[0].distance_m;
    EXPECT_NEAR(beyond_m, 0.02f + kWrist_m, 0.006f) << "it may get there";
    hems = sleeve.hems;
    for (Vec3& p : carried) p.y += 0.1f;
    end_at_wrists(hems, body, carried);
    EXPECT_EQ(hems[0].way_m, way_m) << "a short sleeve stays as it is";
}

TEST(Hems, SleevesThatAreTooLongAreTakenUpAndKeepTheirGirth) {
    const Sleeve fits(1.0f), shorter(0.75f);
    std::vector<Vec2> cut = fits.tube.cut;
    const TakenUp none = take_up(fits.hems, fits.tube.indices, fits.simulated, cut);
    EXPECT_EQ(none.sleeves_m, 0.0f);
    EXPECT_EQ(cut, fits.tube.cut);
    const TakenUp taken = take_up(shorter.hems, shorter.tube.indices, shorter.simulated, cut);
    EXPECT_NEAR(taken.sleeves_m, 0.1f - 0.015f, 0.01f);
    EXPECT_EQ(taken.legs_m, 0.0f);
    const auto hem_of = [&](const std::vector<Vec2>& of) {
        float way = 0.0f;
        for (const Tether& t : shorter.fabric(of).tethers)
            way = t.vertex < 12 ? std::max(way, t.length_m) : way;
        return way;
    };
    EXPECT_NEAR(hem_of(shorter.tube.cut) - hem_of(cut), taken.sleeves_m, 0.015f);
    for (size_t i = 0; i < cut.size(); ++i) {  // sides around the arm
        const size_t n = i % 3 == 2 ? i - 2 : i + 1;
        const Vec2 before = shorter.tube.cut[n] - shorter.tube.cut[i];
        if (std::abs(before.y) < 1e-6f) {
            EXPECT_NEAR(glm::length(cut[n] - cut[i]), glm::length(before), 1e-5f);
        }
    }
}

}  // namespace
}  // namespace vfit
