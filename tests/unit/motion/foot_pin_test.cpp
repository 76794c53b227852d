// One foot that is planted and freed: without a jump of place or speed, and back to where it never left.
#include "motion/foot_pin.h"

#include <gtest/gtest.h>

#include "motion_support.h"

namespace vfit {
namespace {

constexpr float kFrameS = 1.0f / 30.0f, kFloor = 0.08f;

TEST(FootPin, AFootThatComesDownStandsWithinTwoFramesAndStays) {
    FootPin pin(0.15f);
    Vec3 tracked(0.0f, 0.1f, 0.0f), shown(0.0f);
    for (int i = 0; i < 10; ++i) pin.update(tracked += Vec3(0.02f, 0, 0), false, kFloor, kFrameS);  // 0.6 m/s
    Vec3 before(0.0f);
    for (int i = 0; i < 20; ++i) {
        shown = pin.update(tracked += Vec3(0.003f, 0, 0), true, kFloor, kFrameS);
        const float speed = std::hypot(shown.x - before.x, shown.z - before.z) / kFrameS;
        if (i >= 2) {
            EXPECT_LT(speed, 0.025f) << i;
        }
        before = shown;
    }
    EXPECT_NEAR(shown.y, kFloor, 1e-4f);
}

TEST(FootPin, AFootThatIsFreedSpeedsUpAndIsSoonWhereItIsTracked) {
    FootPin pin(0.15f);
    Vec3 tracked(0.0f, kFloor, 0.0f);
    for (int i = 0; i < 30; ++i) pin.update(tracked, true, kFloor, kFrameS);
    Vec3 drifted = tracked + Vec3(0.05f, 0, 0);
    for (int i = 0; i < 30; ++i) pin.update(drifted, true, kFloor, kFrameS);
    Vec3 before = pin.update(drifted, true, kFloor, kFrameS);
    float fastest = 0.0f;
    for (int i = 0; i < 30; ++i) {
        const Vec3 shown = pin.update(drifted, false, kFloor, kFrameS);
        fastest = std::max(fastest, glm::length(shown - before));
        before = shown;
    }
    EXPECT_LT(fastest, 0.25f * 0.05f) << "no more than a quarter of the way in a frame";
    EXPECT_NEAR(glm::length(before - drifted), 0.0f, 1e-4f);
}

TEST(FootPin, AFootThatNeverLeftReturnsToItsPlaceAndOneThatSteppedDoesNot) {
    for (const float step_m : {0.0f, 0.1f}) {
        FootPin pin(0.15f);
        Vec3 tracked(0.0f, kFloor, 0.0f), shown(0.0f);
        for (int i = 0; i < 30; ++i) shown = pin.update(tracked, true, kFloor, kFrameS);
        const Vec3 place = shown;
        for (int i = 0; i < 3; ++i)
            pin.update(tracked + Vec3(0.01f + step_m, 0.01f, 0), false, kFloor, kFrameS);
        for (int i = 0; i < 20; ++i)
            shown = pin.update(tracked + Vec3(0.01f + step_m, 0, 0), true, kFloor, kFrameS);
        if (step_m == 0.0f) {
            EXPECT_LT(glm::length(shown - place), 1e-4f);
        } else {
            EXPECT_GT(shown.x - place.x, 0.02f);
        }
    }
}

TEST(FootPin, TheLeashDragsAPlaceThatIsFarFromWhereTheFootIsTracked) {
    FootPin pin(0.15f);
    for (int i = 0; i < 30; ++i) pin.update({0, kFloor, 0}, true, kFloor, kFrameS);
    const Vec3 shown = pin.update({0.4f, kFloor, 0}, true, kFloor, kFrameS);
    EXPECT_NEAR(shown.x, 0.25f, 1e-3f);
    EXPECT_NEAR(pin.drag().x, 0.25f, 1e-3f);
}

TEST(FootPin, AWholeFootStandsOnTheFloorAndOneOnItsBallWhereItsAnkleIsSeen) {
    for (const float noise_m : {-0.1f, -0.02f, 0.0f, 0.01f, 0.04f})
        EXPECT_FLOAT_EQ(standing_height(kFloor + noise_m, kFloor), kFloor) << noise_m;
    EXPECT_FLOAT_EQ(standing_height(kFloor + 0.12f, kFloor), kFloor + 0.12f);
    float before = kFloor;
    for (float above = 0.0f; above < 0.12f; above += 0.002f) {
        const float height = standing_height(kFloor + above, kFloor);
        EXPECT_GE(height, before) << "a heel that rises is shown to rise";
        before = height;
    }
}

TEST(FootPin, TheFirstFootIsShownWhereItStandsAtOnce) {
    FootPin pin(0.15f);
    EXPECT_NEAR(pin.update({0, kFloor + 0.02f, 0}, true, kFloor, kFrameS).y, kFloor, 1e-6f);
}

TEST(FootPin, AFootOnItsBallRisesAndComesDownWithItsHeel) {
    FootPin pin(0.15f);
    for (int i = 0; i < 30; ++i) pin.update({0, kFloor, 0}, true, kFloor, kFrameS);
    Vec3 shown(0.0f);
    for (const float heel_m : {0.12f, 0.0f}) {
        const float stand = standing_height(kFloor + heel_m, kFloor);
        for (int i = 0; i < 30; ++i) shown = pin.update({0, kFloor + heel_m, 0}, true, stand, kFrameS);
        EXPECT_NEAR(shown.y, kFloor + heel_m, 0.0035f);
    }
}

}  // namespace
}  // namespace vfit
