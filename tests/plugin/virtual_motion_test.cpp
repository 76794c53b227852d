// Motions of the virtual person: smooth, and with feet that do not move while they stand.
#include <cmath>

#include <gtest/gtest.h>

#include "error.h"
#include "motion.h"

namespace vfit::virtual_person {
namespace {

struct Feet {
    std::array<Vec3, 2> ankle, ball, heel, knee, hip;
};

Feet feet_of(const Proportions& p, const BonePose& pose) {
    Feet feet;
    constexpr int kFirst[2] = {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG};
    for (size_t side = 0; side < 2; ++side) {
        const Leg& leg = p.leg[side];
        const auto b = static_cast<size_t>(kFirst[side]);
        const Quat pelvis = pose.rotation[VFIT_BONE_HIPS], thigh = pelvis * pose.rotation[b],
                   shank = thigh * pose.rotation[b + 1], foot = shank * pose.rotation[b + 2];
        feet.hip[side] = pose.hips + pelvis * leg.hip;
        feet.knee[side] = feet.hip[side] + thigh * leg.thigh;
        feet.ankle[side] = feet.knee[side] + shank * leg.shank;
        feet.ball[side] = feet.ankle[side] + foot * Vec3(leg.foot.x, -p.ankle_height_m, leg.foot.z);
        feet.heel[side] = feet.ankle[side] + foot * Vec3(0, -p.ankle_height_m, -0.04f);
    }
    return feet;
}

constexpr double kRate = 30.0;
constexpr int kFrames = 30 * 30;  // longer than the longest motion, so that the loop's seam is in it

class EveryMotion : public ::testing::TestWithParam<const char*> {
protected:
    Proportions proportions = average_proportions();
    std::unique_ptr<Motion> motion = make_scripted_motion(GetParam(), proportions, 5);
};

TEST_P(EveryMotion, PlantedFeetDoNotMoveAndLieOnTheFloor) {
    Feet before{};
    std::array<bool, 2> stood{false, false};
    int contacts = 0;
    for (int i = 0; i < kFrames; ++i) {
        const BonePose pose = motion->at(i / kRate);
        const Feet feet = feet_of(proportions, pose);
        for (size_t side = 0; side < 2; ++side) {
            if (pose.contact[side]) {
                ++contacts;
                ASSERT_NEAR(feet.ball[side].y, 0.0f, 0.001f) << "frame " << i << " side " << side;
                ASSERT_NEAR(feet.heel[side].y, 0.0f, 0.001f) << "frame " << i << " side " << side;
                if (stood[side]) {
                    ASSERT_LT(glm::distance(feet.ankle[side], before.ankle[side]), 0.001f)
                        << "frame " << i << " side " << side;
                }
            }
            stood[side] = pose.contact[side];
        }
        if (std::string(GetParam()) != "jump") {
            const float lowest = std::min({feet.ball[0].y, feet.heel[0].y, feet.ball[1].y, feet.heel[1].y});
            ASSERT_LT(lowest, 0.002f) << "both feet in the air at frame " << i;
        }
        before = feet;
    }
    EXPECT_GT(contacts, kFrames / 3);
}

TEST_P(EveryMotion, SwingingFeetStayAboveTheFloor) {
    for (int i = 0; i < kFrames; ++i) {
        const Feet feet = feet_of(proportions, motion->at(i / kRate));
        for (size_t side = 0; side < 2; ++side) {
            ASSERT_GT(feet.ball[side].y, -0.002f) << i;
            ASSERT_GT(feet.heel[side].y, -0.002f) << i;
        }
    }
}

TEST_P(EveryMotion, KneesBendForwardsAndNeverPastStraight) {
    for (int i = 0; i < kFrames; ++i) {
        const BonePose pose = motion->at(i / kRate);
        const Feet feet = feet_of(proportions, pose);
        for (size_t side = 0; side < 2; ++side) {
            const Vec3 line = glm::normalize(feet.ankle[side] - feet.hip[side]);
            const Vec3 out = feet.knee[side] - feet.hip[side];
            const Vec3 bend = out - line * glm::dot(out, line);
            // The knee points where the toes point, or between toes and pelvis.
            const Vec3 toes = feet.ball[side] - feet.heel[side];
            ASSERT_GT(glm::dot(bend, toes), 0.0f) << i;
        }
    }
}

TEST_P(EveryMotion, NoJointJumps) {
    // Fastest voluntary motions of arms are near 15 rad/s at the elbow; nothing here should come close. Hips
    // move at walking speed, or at that of who leaves the floor: 1.72 m/s for 15 cm, with knees that extend
    // by some 16 rad/s as those of jumpers do.
    const bool jumps = std::string(GetParam()) == "jump";
    const double fastest = jumps ? 1.73 : 1.5, quickest = jumps ? 16.0 : 10.0;
    BonePose before = motion->at(0);
    for (int i = 1; i < kFrames; ++i) {
        const BonePose pose = motion->at(i / kRate);
        ASSERT_LT(glm::distance(pose.hips, before.hips) * kRate, fastest) << i;
        for (size_t b = 0; b < VFIT_BONE_COUNT; ++b) {
            const float cosine = std::min(1.0f, std::abs(glm::dot(pose.rotation[b], before.rotation[b])));
            ASSERT_LT(2.0f * std::acos(cosine) * kRate, quickest) << "frame " << i << " bone " << b;
        }
        before = pose;
    }
}

INSTANTIATE_TEST_SUITE_P(Scripts, EveryMotion,
                         ::testing::Values("scan", "side", "sway", "turn", "walk", "wave", "reach", "squat",
                                           "demo", "cross", "clap", "forward", "sit", "spin", "round", "jog",
                                           "visit", "jump", "step", "balance", "stride", "shuffle"),
                         [](const auto& info) { return std::string(info.param); });

TEST(JumpMotion, FliesAsHighAndAsLongAsABodyDoesAndLandsWhereItStood) {
    const Proportions p = average_proportions();
    const auto motion = make_scripted_motion("jump", p, 1);
    const Feet standing = feet_of(p, motion->at(0.0));
    float highest = 0.0f;
    int flying = 0;
    for (int i = 0; i < int(3 * kRate); ++i) {
        const BonePose pose = motion->at(i / kRate);
        const Feet feet = feet_of(p, pose);
        EXPECT_EQ(pose.contact[0], pose.contact[1]);
        flying += !pose.contact[0];
        for (size_t side = 0; side < 2; ++side) {
            highest = std::max(highest, feet.heel[side].y);
            EXPECT_NEAR(feet.ankle[side].x, standing.ankle[side].x, 0.001f);
            EXPECT_NEAR(feet.ankle[side].z, standing.ankle[side].z, 0.001f);
        }
    }
    EXPECT_NEAR(highest, 0.15f, 0.005f);
    EXPECT_NEAR(flying / kRate, 2.0 * std::sqrt(2.0 * 0.15 / 9.81), 1.5 / kRate);
}

TEST(BalanceMotion, HoldsOneFootUpAfterTheOther) {
    const Proportions p = average_proportions();
    const auto motion = make_scripted_motion("balance", p, 1);
    int up[2] = {0, 0};
    for (int i = 0; i < int(7 * kRate); ++i) {
        const BonePose pose = motion->at(i / kRate);
        EXPECT_TRUE(pose.contact[0] || pose.contact[1]) << i;
        for (size_t side = 0; side < 2; ++side)
            up[side] += !pose.contact[side] && feet_of(p, pose).ankle[side].y > 0.2f;
    }
    EXPECT_GT(up[0], kRate);
    EXPECT_GT(up[1], kRate);
}

TEST(ScanMotion, ArmsAreHeldOutAndFeetAQuarterMetreApart) {
    const Proportions p = average_proportions();
    const BonePose pose = make_scripted_motion("scan", p, 1)->at(1.0);
    const Feet feet = feet_of(p, pose);
    EXPECT_NEAR(feet.ankle[0].x - feet.ankle[1].x, 0.25f, 0.001f);
    for (const int side : {kLeft, kRight}) {
        const int clavicle = side == kLeft ? VFIT_BONE_LEFT_SHOULDER : VFIT_BONE_RIGHT_SHOULDER;
        const Vec3 arm = pose.rotation[size_t(clavicle)] *
                         (pose.rotation[size_t(clavicle) + 1] * p.upper_arm[size_t(side)]);
        const float from_down = glm::degrees(std::acos(glm::dot(glm::normalize(arm), Vec3(0, -1, 0))));
        EXPECT_NEAR(from_down, 35.0f, 1.0f);
        EXPECT_GT(arm.x * side_sign(side), 0.0f);
    }
}

TEST(ScanMotion, ArmsAreHeldAsOptionArmsSays) {
    const Proportions p = average_proportions();
    const auto arm_of = [&](const char* motion, float arms_deg) {
        const BonePose pose = make_scripted_motion(motion, p, 1, arms_deg)->at(1.0);
        return glm::normalize(pose.rotation[VFIT_BONE_LEFT_SHOULDER] *
                              (pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] * p.upper_arm[size_t(kLeft)]));
    };
    const auto from_down = [](const Vec3& arm) { return glm::degrees(std::acos(-arm.y)); };
    const Vec3 out = arm_of("scan", 50.0f), ahead = arm_of("side", 50.0f), down = arm_of("scan", 0.0f);
    EXPECT_NEAR(from_down(out), 50.0f, 1.0f);
    EXPECT_GT(out.x, 0.7f);
    EXPECT_NEAR(from_down(ahead), 50.0f, 3.0f);
    EXPECT_GT(ahead.z, 0.7f);
    EXPECT_LT(from_down(down), 3.0f);
    EXPECT_NEAR(from_down(arm_of("scan", -1.0f)), 35.0f, 1.0f) << "below 0: as the motion has them";
    EXPECT_NEAR(from_down(arm_of("sway", 60.0f)), from_down(arm_of("sway", -1.0f)), 1e-3f)
        << "other motions have arms of their own";
}

TEST(TurnMotion, ShowsEverySideAndComesBack) {
    const auto motion = make_scripted_motion("turn", average_proportions(), 1);
    const auto faces = [&](double t) { return motion->at(t).rotation[VFIT_BONE_HIPS] * Vec3(0, 0, 1); };
    EXPECT_GT(faces(0.1).z, 0.99f);
    EXPECT_GT(faces(3.2).x, 0.99f);
    EXPECT_LT(faces(6.4).z, -0.99f);
    EXPECT_LT(faces(9.6).x, -0.99f);
    EXPECT_GT(faces(12.8).z, 0.99f);
}

TEST(WalkMotion, FollowsACircleThatClosesAtTheStart) {
    const auto motion = make_scripted_motion("walk", average_proportions(), 1);
    Vec2 low(10), high(-10);
    for (int i = 0; i < 480; ++i) {
        const Vec3 hips = motion->at(i / 100.0).hips;
        low = glm::min(low, Vec2(hips.x, hips.z)), high = glm::max(high, Vec2(hips.x, hips.z));
    }
    EXPECT_NEAR(high.x - low.x, 0.9f, 0.08f);
    EXPECT_NEAR(high.y - low.y, 0.9f, 0.08f);
    EXPECT_NEAR(glm::length(low + high), 0.0f, 0.08f) << "the circle is centred where the others stand";
}

TEST(Motions, SeedsShiftTheSwayAndNothingElse) {
    const Proportions p = average_proportions();
    const BonePose a = make_scripted_motion("scan", p, 1)->at(2.0),
                   b = make_scripted_motion("scan", p, 2)->at(2.0),
                   c = make_scripted_motion("scan", p, 1)->at(2.0);
    EXPECT_EQ(a.hips, c.hips);
    EXPECT_NE(a.hips, b.hips);
    EXPECT_LT(glm::distance(a.hips, b.hips), 0.03f);
}

TEST(Motions, AnUnknownNameIsAnErrorThatListsTheKnown) {
    try {
        make_scripted_motion("moonwalk", average_proportions(), 1);
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), VFIT_ERROR_ARGUMENT);
        EXPECT_NE(std::string(e.what()).find("moonwalk"), std::string::npos);
        EXPECT_NE(std::string(e.what()).find("squat"), std::string::npos);
    }
}

}  // namespace
}  // namespace vfit::virtual_person
