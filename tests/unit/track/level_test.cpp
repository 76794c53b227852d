// Which way is up, as people show it.
#include "track/level.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vfit {
namespace {

constexpr Level::Answers kUpright = {12.0f, -2.0f, 1.0f, -3.0f}, kOnTheHead = {1.0f, -3.0f, 11.0f, -2.0f};

/// A balanced body 2.5 m before a camera that sees `up`, on a floor 1 m below the camera; bent forward by
/// `lean_m` at the neck, with the hips as far back as balance needs.
Body standing(const Vec3& up, float lean_m = 0.0f) {
    const Vec3 back = glm::normalize(Vec3(0, 0, -1) - up * glm::dot(Vec3(0, 0, -1), up));
    const Vec3 left = glm::cross(up, back);
    const auto at = [&](float x, float y, float z) { return left * x + up * (y - 1.0f) + back * (z - 2.5f); };
    const float hips = -lean_m;  // what bends forward weighs as much as what goes back
    Body b;
    b.set(VFIT_JOINT_HEAD, at(0, 1.6f, 1.1f * lean_m));
    b.set(VFIT_JOINT_NECK, at(0, 1.45f, lean_m));
    b.set(VFIT_JOINT_PELVIS, at(0, 0.95f, hips));
    for (const float side : {1.0f, -1.0f}) {
        const bool is_left = side > 0;
        const auto set = [&](int left_joint, const Vec3& p) {
            b.set(is_left ? left_joint : mirrored_joint(left_joint), p);
        };
        set(VFIT_JOINT_LEFT_SHOULDER, at(side * 0.18f, 1.4f, lean_m));
        set(VFIT_JOINT_LEFT_HAND, at(side * 0.25f, 0.85f, lean_m));
        set(VFIT_JOINT_LEFT_HIP, at(side * 0.1f, 0.9f, hips));
        set(VFIT_JOINT_LEFT_KNEE, at(side * 0.1f, 0.5f, 0.5f * hips));
        // The pressure is a third of the way from the ankle to the ball of the foot.
        set(VFIT_JOINT_LEFT_FOOT, at(side * 0.1f, 0.08f, -0.05f));
        set(VFIT_JOINT_LEFT_TOES, at(side * 0.1f, 0.03f, 0.093f));
    }
    return b;
}

double degrees_between(const Vec3& a, const Vec3& b) {
    return std::acos(std::min(1.0f, glm::dot(glm::normalize(a), glm::normalize(b)))) * 180.0 / double(kPi);
}

TEST(Level, IsTheImagesOwnUntilPeopleShowAnother) {
    Level level;
    EXPECT_EQ(level.up(), Vec3(0, -1, 0));
    EXPECT_TRUE(level.compare(kUpright));
    EXPECT_EQ(level.up(), Vec3(0, -1, 0));
    EXPECT_FALSE(level.compare(kOnTheHead));
    EXPECT_LT(degrees_between(level.up(), Vec3(0, 1, 0)), 0.1);
    EXPECT_TRUE(level.compare(kUpright));
}

TEST(Level, WhoTurnsOutToBeNoPersonTellsNothing) {
    Level level;
    EXPECT_FALSE(level.compare(kOnTheHead));
    ASSERT_LT(degrees_between(level.up(), Vec3(0, 1, 0)), 0.1);
    level.miss(1);  // with that way up, no person is seen
    level.keep(Vec3(0, -1, 0));
    EXPECT_EQ(level.up(), Vec3(0, -1, 0));
    ASSERT_TRUE(level.miss(2));
    EXPECT_LT(degrees_between(level.up(), Vec3(1, 0, 0)), 0.1) << "the next way goes on from there";
}

TEST(Level, AWeakAnswerIsTakenWhenNoOtherWayIsBetter) {
    constexpr Level::Answers weak = {1.0f, 4.0f, -1.0f, 2.0f};
    Level level;
    for (int image = 0; image < 30; ++image) {
        int ways = 0;
        while (!level.compare(weak)) {
            ASSERT_TRUE(level.miss(1)) << image;
            ++ways;
        }
        EXPECT_EQ(ways, image < 10 ? 4 : 0) << image;  // ids would change with every try
        EXPECT_LT(degrees_between(level.up(), Vec3(0, -1, 0)), 0.1);
        EXPECT_FALSE(level.sure());
    }
}

TEST(Level, AWeakAnswerGivesWayToAStrongOneOfAnotherSide) {
    Level level;
    EXPECT_FALSE(level.compare({2.0f, 1.0f, 0.0f, 3.0f}));  // several people side by side, seen lying
    EXPECT_TRUE(level.miss(1));
    EXPECT_TRUE(level.compare(kUpright));
    EXPECT_LT(degrees_between(level.up(), Vec3(1, 0, 0)), 0.1);
}

TEST(Level, ASourceThatStartsAgainRaisesDoubt) {
    Level level;
    for (int i = 0; i < 10; ++i) level.compare(kUpright);
    level.see(standing({0, -1, 0}), 9'000'000'000);
    ASSERT_TRUE(level.sure());
    level.miss(1'000'000'000);
    EXPECT_FALSE(level.sure());
}

TEST(Level, AWeakAnswerThatStandsAloneIsBelievedOnAnotherTry) {
    Level level;
    level.miss(1), level.miss(1);  // the second of the other ways: upside down
    EXPECT_FALSE(level.compare({2.5f, 0.0f, 1.0f, -3.0f}));
    EXPECT_TRUE(level.compare({2.5f, -1.0f, -2.0f, -3.0f}));
    EXPECT_LT(degrees_between(level.up(), Vec3(0, 1, 0)), 0.1);
}

TEST(Level, TriesEachSideOnceAndComesBack) {
    Level level;
    std::array<int, 4> tried{};
    bool again = true;
    for (int i = 0; again && i < 10; ++i) {
        const Vec3 up = level.up();
        ++tried[up.y < -0.5f ? 0 : up.x > 0.5f ? 1 : up.y > 0.5f ? 2 : 3];
        again = level.miss(1);
    }
    EXPECT_EQ(tried, (std::array<int, 4>{2, 1, 1, 1}));  // the first side again at last
    EXPECT_EQ(level.up(), Vec3(0, -1, 0));
}

TEST(Level, OnceSureOnlySecondsWithoutAPersonRaiseDoubt) {
    Level level;
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(level.compare(kUpright));
    ASSERT_TRUE(level.sure());
    level.see(standing({0, -1, 0}), 1'000'000'000);
    EXPECT_FALSE(level.miss(2'900'000'000));
    EXPECT_TRUE(level.sure());
    EXPECT_TRUE(level.miss(3'100'000'000));
    EXPECT_FALSE(level.sure());
}

TEST(Level, FloorLiesBelowAPersonInBalance) {
    for (const float lean : {0.0f, 0.15f, 0.3f})
        for (const float roll : {0.0f, 20.0f, -35.0f, 180.0f}) {
            Camera truth;
            set_floor(truth, 1.0f, 12.0f * kPi / 180.0f, roll * kPi / 180.0f, VFIT_FLOOR_GIVEN);
            Level level;
            if (std::abs(roll) > 90.0f) level.compare(kOnTheHead);
            level.see(standing(truth.floor_normal, lean), 1);
            Camera camera;
            level.place(camera);
            EXPECT_EQ(camera.floor_state, VFIT_FLOOR_ESTIMATED);
            EXPECT_LT(degrees_between(camera.floor_normal, truth.floor_normal), 2.0) << lean << " " << roll;
            EXPECT_NEAR(camera.floor_distance_m, 1.0f, 0.1f) << lean << " " << roll;
        }
}

TEST(Level, WhoSitsTellsTheHeightAlone) {
    Body body = standing({0, -1, 0});
    for (const int knee : {VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_RIGHT_KNEE})
        body.set(knee, body.at(knee) + Vec3(0, 0, -0.45f));
    for (const int hip : {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_PELVIS})
        body.set(hip, body.at(hip) + Vec3(0, 0.3f, 0.2f));
    Level level;
    level.see(body, 1);
    Camera camera;
    level.place(camera);
    EXPECT_EQ(camera.floor_normal, Vec3(0, -1, 0));
    EXPECT_NEAR(camera.floor_distance_m, 1.0f, 0.02f);
}

}  // namespace
}  // namespace vfit
