// Ankles that a tracker puts where the other one is.
#include "motion/hidden_feet.h"

#include <gtest/gtest.h>

#include "motion_support.h"

namespace vfit {
namespace {

constexpr float kApart = 0.4f;  // of the feet in a stride

Body stride(int frame, float right_x, float left_x = 0.0f) {
    Body body;
    body.time_ns = testing::frame_ns(frame);
    body.set(VFIT_JOINT_LEFT_FOOT, {left_x, 0.08f, -2.0f});
    body.set(VFIT_JOINT_RIGHT_FOOT, {right_x, 0.08f, -2.0f});
    body.set(VFIT_JOINT_RIGHT_TOES, {right_x + 0.15f, 0.03f, -2.0f});
    return body;
}

constexpr bool kRightStands[2] = {false, true};

TEST(HiddenFeet, OneThatIsSeenWhereTheOtherIsStandsWhereItStood) {
    HiddenFeet feet;
    int f = 0;
    for (; f < 10; ++f) feet.put_back(stride(f, kApart), kRightStands);
    for (int hidden = 0; hidden < 10; ++hidden, ++f) {
        const Body body = feet.put_back(stride(f, 0.05f), kRightStands);
        EXPECT_NEAR(body.at(VFIT_JOINT_RIGHT_FOOT).x, kApart, 1e-4f) << hidden;
        EXPECT_NEAR(body.at(VFIT_JOINT_RIGHT_TOES).x, kApart + 0.15f, 1e-4f);
        EXPECT_EQ(body.joints[VFIT_JOINT_RIGHT_FOOT].state, VFIT_JOINT_INFERRED);
        EXPECT_NEAR(body.at(VFIT_JOINT_LEFT_FOOT).x, 0.0f, 1e-6f);
    }
    // Not for ever.
    for (int late = 0; late < 10; ++late, ++f) feet.put_back(stride(f, 0.05f), kRightStands);
    EXPECT_NEAR(feet.put_back(stride(f, 0.05f), kRightStands).at(VFIT_JOINT_RIGHT_FOOT).x, 0.05f, 1e-6f);
}

TEST(HiddenFeet, OneThatStepsIsFree) {
    HiddenFeet feet;
    int f = 0;
    for (; f < 10; ++f) feet.put_back(stride(f, kApart), kRightStands);
    constexpr bool free[2] = {true, false};  // a step past the other foot
    for (int step = 0; step < 12; ++step, ++f) {
        const Body body = stride(f, kApart - 0.07f * float(step));
        EXPECT_EQ(feet.put_back(body, free).at(VFIT_JOINT_RIGHT_FOOT), body.at(VFIT_JOINT_RIGHT_FOOT))
            << step;
    }
}

TEST(HiddenFeet, FeetThatStandTogetherOrSlideStay) {
    HiddenFeet feet;
    constexpr bool both[2] = {true, true};
    for (int f = 0; f < 60; ++f) {
        // Side by side, the right one creeping along by 15 cm.
        const Body body = stride(f, 0.15f + 0.0025f * float(f));
        EXPECT_EQ(feet.put_back(body, both).at(VFIT_JOINT_RIGHT_FOOT), body.at(VFIT_JOINT_RIGHT_FOOT)) << f;
    }
}

TEST(HiddenFeet, OneThatTheSensorLosesIsNoBusinessOfTheirs) {
    HiddenFeet feet;
    for (int f = 0; f < 5; ++f) feet.put_back(stride(f, kApart), kRightStands);
    Body body = stride(5, kApart);
    body.joints[VFIT_JOINT_RIGHT_FOOT] = Joint();
    EXPECT_FALSE(feet.put_back(body, kRightStands).has(VFIT_JOINT_RIGHT_FOOT));
}

}  // namespace
}  // namespace vfit
