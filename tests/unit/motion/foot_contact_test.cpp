// Contact thresholds: hysteresis, a foot held up, a floor that is not where it was said to be.
#include "motion/foot_contact.h"

#include <gtest/gtest.h>

#include "motion_support.h"

namespace vfit {
namespace {

struct Feet {
    FootContact contact;
    int frame = 0;
    void step(float left_y, float right_y, float left_x = 0, bool left_known = true) {
        const Vec3 ankles[2] = {{left_x, left_y, 0}, {-0.2f, right_y, 0}};
        const bool known[2] = {left_known, true};
        contact.update(ankles, known, testing::frame_ns(frame++));
    }
};

TEST(FootContact, FirstFrameTakesTheLowerFootAndOneBesideIt) {
    Feet level, raised;
    level.step(-0.30f, -0.29f);  // the floor was estimated wrong by far
    EXPECT_TRUE(level.contact.planted(0) && level.contact.planted(1));
    raised.step(0.30f, 0.08f);
    EXPECT_FALSE(raised.contact.planted(0));
    EXPECT_TRUE(raised.contact.planted(1));
}

TEST(FootContact, AFootHeldUpForLongIsNeverPlanted) {
    Feet feet;
    feet.step(0.08f, 0.08f);
    for (int i = 1; i <= 10; ++i) feet.step(0.08f + 0.015f * static_cast<float>(i), 0.08f);
    for (int i = 0; i < 600; ++i) {
        feet.step(0.23f, 0.08f);
        ASSERT_FALSE(feet.contact.planted(0)) << i;
        ASSERT_TRUE(feet.contact.planted(1)) << i;
    }
    for (int i = 0; i < 10; ++i) feet.step(0.08f, 0.08f);
    EXPECT_TRUE(feet.contact.planted(0));
}

TEST(FootContact, KeepsAFootBetweenItsTwoThresholdsAsItWas) {
    Feet feet;
    feet.step(0.08f, 0.08f);
    for (int i = 1; i <= 25; ++i) feet.step(0.08f + 0.002f * static_cast<float>(i), 0.08f);  // to 50 mm
    EXPECT_TRUE(feet.contact.planted(0));
    feet.step(0.20f, 0.08f);
    EXPECT_FALSE(feet.contact.planted(0));
    for (int i = 0; i < 10; ++i) feet.step(0.15f, 0.08f);
    EXPECT_FALSE(feet.contact.planted(0));
}

TEST(FootContact, FreesAFastFootAndPlantsItWhenItRests) {
    Feet feet;
    for (int i = 0; i < 10; ++i) feet.step(0.08f, 0.08f);
    float x = 0;
    for (int i = 0; i < 10; ++i) feet.step(0.08f, 0.08f, x += 0.04f);  // 1.2 m/s, as low as before
    EXPECT_FALSE(feet.contact.planted(0));
    bool switched = false;
    for (int i = 0; i < 15; ++i) {
        feet.step(0.08f, 0.08f, x);
        switched = switched || feet.contact.switched();
    }
    EXPECT_TRUE(feet.contact.planted(0));
    EXPECT_TRUE(switched);
}

TEST(FootContact, AFootThatIsNotSeenIsNotPlanted) {
    Feet feet;
    feet.step(0.08f, 0.08f);
    feet.step(0.0f, 0.08f, 0, false);
    EXPECT_FALSE(feet.contact.planted(0));
    EXPECT_TRUE(feet.contact.planted(1));
}

}  // namespace
}  // namespace vfit
