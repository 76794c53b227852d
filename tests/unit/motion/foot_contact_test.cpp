// Contact thresholds: hysteresis, a foot held up, a floor that is not where it was said to be.
#include "motion/foot_contact.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motion_support.h"

namespace vfit {
namespace {

struct Feet {
    FootContact contact;
    int frame = 0;
    vfit_contact_rule rule = VFIT_CONTACT_THRESHOLDS;
    void step(float left_y, float right_y, float left_x = 0, bool left_known = true) {
        Body body;
        body.time_ns = testing::frame_ns(frame++);
        if (left_known) body.set(VFIT_JOINT_LEFT_FOOT, {left_x, left_y, 0});
        body.set(VFIT_JOINT_RIGHT_FOOT, {-0.2f, right_y, 0});
        contact.update(body, rule);
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

TEST(FootContact, AFootThatIsHiddenStandsForAMomentAndNoLonger) {
    for (const vfit_contact_rule rule : {VFIT_CONTACT_THRESHOLDS, VFIT_CONTACT_LEARNT}) {
        Feet feet;
        feet.rule = rule;
        for (int i = 0; i < 10; ++i) feet.step(0.08f, 0.08f);
        for (int i = 0; i < 9; ++i) {
            feet.step(0.0f, 0.08f, 0, false);
            EXPECT_TRUE(feet.contact.planted(0)) << i;
        }
        for (int i = 0; i < 9; ++i) feet.step(0.0f, 0.08f, 0, false);
        EXPECT_FALSE(feet.contact.planted(0));
        EXPECT_TRUE(feet.contact.planted(1));
    }
}

TEST(FootContact, WhatIsHighNeverStandsHoweverSlow) {
    Feet feet;
    feet.rule = VFIT_CONTACT_LEARNT;
    for (int i = 0; i < 30; ++i) feet.step(0.08f, 0.08f);
    EXPECT_TRUE(feet.contact.planted(0) && feet.contact.planted(1));
    for (int i = 1; i <= 6; ++i) feet.step(0.08f + 0.05f * static_cast<float>(i), 0.08f);
    for (int i = 0; i < 120; ++i) {
        feet.step(0.38f, 0.08f);
        ASSERT_FALSE(feet.contact.planted(0)) << i;
        ASSERT_TRUE(feet.contact.planted(1)) << i;
    }
}

TEST(FootContact, LegsTakenForOneAnotherLeaveOneDown) {
    // Both feet seem to step at once while the hips stay where they are.
    Feet feet;
    feet.rule = VFIT_CONTACT_LEARNT;
    Body body;
    for (int i = 0; i < 60; ++i) {
        const float swap = i >= 40 && i < 50 ? 0.1f * static_cast<float>(i - 39) : 0.0f;
        body.time_ns = testing::frame_ns(i);
        body.set(VFIT_JOINT_LEFT_HIP, {0.1f, 0.9f, 0});
        body.set(VFIT_JOINT_RIGHT_HIP, {-0.1f, 0.9f, 0});
        body.set(VFIT_JOINT_LEFT_FOOT, {0.1f - swap, 0.08f, 0});
        body.set(VFIT_JOINT_RIGHT_FOOT, {-0.1f + swap, 0.08f, 0});
        feet.contact.update(body, feet.rule);
        EXPECT_TRUE(feet.contact.planted(0) || feet.contact.planted(1)) << i;
    }
}

TEST(FootContact, TheNetworkTellsTheSameAtAnyFrameRate) {
    // A step of 0.4 s: lifted at about the same time whatever the rate.
    for (const double rate : {30.0, 60.0, 120.0}) {
        FootContact contact;
        double lifted_from = 0, lifted_to = 0;
        for (int i = 0; i < int(3 * rate); ++i) {
            const double t = double(i) / rate;
            const auto swing = float(std::clamp((t - 1.5) / 0.4, 0.0, 1.0));
            Body body;
            body.time_ns = testing::frame_ns(i, rate);
            body.set(VFIT_JOINT_LEFT_HIP, {0.1f, 0.9f, 0.15f * swing});
            body.set(VFIT_JOINT_RIGHT_HIP, {-0.1f, 0.9f, 0.15f * swing});
            body.set(VFIT_JOINT_RIGHT_FOOT, {-0.1f, 0.08f, 0});
            const float forward = swing * swing * (3.0f - 2.0f * swing);
            body.set(VFIT_JOINT_LEFT_FOOT, {0.1f, 0.08f + 0.1f * std::sin(kPi * swing), 0.3f * forward});
            contact.update(body, VFIT_CONTACT_LEARNT);
            EXPECT_TRUE(contact.planted(1)) << rate << " Hz, " << t;
            if (!contact.planted(0) && lifted_from == 0) lifted_from = t;
            if (!contact.planted(0)) lifted_to = t;
        }
        EXPECT_NEAR(lifted_from, 1.55, 0.055) << rate;
        EXPECT_NEAR(lifted_to, 1.9, 0.09) << rate;
    }
}

TEST(FootContact, ASingleReadingThatIsOffFreesNoFoot) {
    for (const Vec3& off : {Vec3(0.08f, 0, 0), Vec3(0, 0.08f, 0), Vec3(0, 0, -0.08f)}) {
        FootContact contact;
        for (int i = 0; i < 60; ++i) {
            Body body;
            body.time_ns = testing::frame_ns(i, 30.0);
            for (const bool left : {true, false}) {
                const auto set = [&](int joint, const Vec3& p) {
                    body.set(left ? joint : mirrored_joint(joint), {left ? p.x : -p.x, p.y, p.z});
                };
                set(VFIT_JOINT_LEFT_HIP, {0.1f, 0.9f, 0});
                set(VFIT_JOINT_LEFT_KNEE, {0.1f, 0.5f, 0.02f});
                set(VFIT_JOINT_LEFT_FOOT, {0.1f, 0.08f, 0});
                set(VFIT_JOINT_LEFT_TOES, {0.1f, 0.02f, 0.13f});
            }
            if (i == 40) body.joints[VFIT_JOINT_LEFT_FOOT].position += off;
            contact.update(body, VFIT_CONTACT_LEARNT);
            if (i > 15) EXPECT_TRUE(contact.planted(0) && contact.planted(1)) << i << ", " << off.y;
        }
    }
}

TEST(FootContact, TheNetworkTakesAFootThatRollsForFree) {
    // Push-off: the heel turns by 50 degrees about the ball, which stays where it is, in 0.3 s.
    constexpr float kBall_m = 0.13f, kBallHeight_m = 0.02f, kAnkleHeight_m = 0.08f;
    FootContact contact;
    double free_from = 0;
    for (int i = 0; i < 70; ++i) {
        const double t = i / 30.0;
        const float heel_rad = 50.0f * kPi / 180.0f * float(std::clamp((t - 2.0) / 0.3, 0.0, 1.0));
        const float c = std::cos(heel_rad), s = std::sin(heel_rad), up = kAnkleHeight_m - kBallHeight_m;
        Body body;
        body.time_ns = testing::frame_ns(i, 30.0);
        const Vec3 ankle(0.1f, kBallHeight_m + c * up + s * kBall_m, kBall_m - c * kBall_m + s * up);
        body.set(VFIT_JOINT_LEFT_FOOT, ankle);
        body.set(VFIT_JOINT_LEFT_TOES, {0.1f, kBallHeight_m, kBall_m});
        body.set(VFIT_JOINT_LEFT_KNEE, ankle + Vec3(0.0f, 0.4f * c, 0.4f * s));
        body.set(VFIT_JOINT_LEFT_HIP, {0.1f, 0.9f, 0.1f * heel_rad});
        body.set(VFIT_JOINT_RIGHT_HIP, {-0.1f, 0.9f, 0.1f * heel_rad});
        body.set(VFIT_JOINT_RIGHT_KNEE, {-0.1f, 0.5f, 0.3f});
        body.set(VFIT_JOINT_RIGHT_FOOT, {-0.1f, kAnkleHeight_m, 0.35f});
        body.set(VFIT_JOINT_RIGHT_TOES, {-0.1f, kBallHeight_m, 0.35f + kBall_m});
        contact.update(body, VFIT_CONTACT_LEARNT);
        EXPECT_TRUE(contact.planted(1)) << t;
        if (t > 0.5 && t < 2.0) EXPECT_TRUE(contact.planted(0)) << t;
        if (!contact.planted(0) && free_from == 0) free_from = t;
    }
    EXPECT_NEAR(free_from, 2.15, 0.1);
}

}  // namespace
}  // namespace vfit
