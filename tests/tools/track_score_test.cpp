// How tracked joints are scored, and the cases that vfit-bench track plays.
#include "bench/track_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bench/track_cases.h"

namespace vfit::tools {
namespace {

/// A person who stands 2.5 m away and is turned by that angle to their left, in camera space (y down).
Joints person(double turned_rad = 0.0) {
    Joints joints;
    const auto put = [&](int j, double left, double up) {
        joints.at[size_t(j)] = {left * std::cos(turned_rad), 1.0 - up, 2.5 + left * std::sin(turned_rad)};
    };
    put(VFIT_JOINT_HEAD, 0, 1.7), put(VFIT_JOINT_NECK, 0, 1.5), put(VFIT_JOINT_TORSO, 0, 1.2);
    const double at[][2] = {{0.2, 1.45}, {0.3, 1.2}, {0.35, 0.9}, {0.1, 0.95}, {0.1, 0.5}, {0.1, 0.1}};
    for (int i = 0; i < 6; ++i) {
        put(VFIT_JOINT_LEFT_SHOULDER + 2 * i, at[i][0], at[i][1]);
        put(VFIT_JOINT_RIGHT_SHOULDER + 2 * i, -at[i][0], at[i][1]);
    }
    return joints;
}

TEST(Errors, CountSharesMeansAndMedians) {
    Errors e;
    for (const double d : {0.02, 0.04, 0.30}) e.add(VFIT_JOINT_HEAD, d);
    e.add(VFIT_JOINT_NECK, 0.08);
    EXPECT_NEAR(e.within(0.1, VFIT_JOINT_HEAD), 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(e.within(0.1), 0.75, 1e-12);
    EXPECT_NEAR(e.mean(VFIT_JOINT_HEAD), 0.12, 1e-12);
    EXPECT_NEAR(e.median(VFIT_JOINT_HEAD), 0.04, 1e-12);
    EXPECT_EQ(e.count(), 4u);
}

TEST(Errors, AJointThatIsNotFoundIsWithinNoDistance) {
    Errors e;
    e.add(VFIT_JOINT_HEAD, 0.02);
    e.add_missing(VFIT_JOINT_HEAD);
    EXPECT_NEAR(e.within(0.1, VFIT_JOINT_HEAD), 0.5, 1e-12);
    EXPECT_NEAR(e.mean(VFIT_JOINT_HEAD), 0.02, 1e-12);
    EXPECT_EQ(e.missing(), 1u);
    EXPECT_EQ(Errors().within(0.1), 0.0) << "nothing judged is nothing found";
}

TEST(Errors, AFrameWithoutABodyMissesAllJointsThatTheReferenceHas) {
    Errors e;
    Joints reference = person();
    reference.at[VFIT_JOINT_LEFT_HAND].fill(NAN);
    e.add_all(nullptr, reference);
    EXPECT_EQ(e.missing(), 14u);
    Joints half = person();
    half.at[VFIT_JOINT_HEAD].fill(NAN);
    e.add_all(&half, reference);
    EXPECT_EQ(e.missing(), 15u);
    EXPECT_EQ(e.count(), 13u);
    EXPECT_NEAR(e.within(0.1), 13.0 / 28.0, 1e-12);
}

TEST(Errors, MergedAreAsIfAddedToOne) {
    Errors a, b, both;
    a.add(3, 0.05), both.add(3, 0.05);
    b.add(3, 0.20), both.add(3, 0.20);
    b.add_missing(4), both.add_missing(4);
    a.merge(b);
    EXPECT_EQ(a.json().dump(), both.json().dump());
}

TEST(Sides, ExchangedOnesAreNoticed) {
    const Joints truth = person();
    EXPECT_FALSE(sides_are_exchanged(truth, truth));
    EXPECT_TRUE(sides_are_exchanged(with_sides_exchanged(truth), truth));
    Joints one_hand = truth;  // a wrong hand is no exchange
    one_hand.at[VFIT_JOINT_LEFT_HAND] = truth.at[VFIT_JOINT_RIGHT_HAND];
    EXPECT_FALSE(sides_are_exchanged(one_hand, truth));
}

TEST(View, IsTheAngleByWhichThePersonIsTurnedAway) {
    for (const double degrees : {0.0, 30.0, -30.0, 90.0, -90.0, 150.0, 180.0}) {
        const double rad = degrees * 3.14159265358979 / 180.0;
        EXPECT_NEAR(turned_away_rad(person(rad)), std::abs(rad), 1e-6) << degrees;
    }
    Joints no_hips = person();
    no_hips.at[VFIT_JOINT_LEFT_HIP].fill(NAN);
    EXPECT_TRUE(std::isnan(turned_away_rad(no_hips)));
}

TEST(TrackCases, FollowTheSeedAndUseEachBodyOnce) {
    const auto a = track_cases(1, false), same = track_cases(1, false), other = track_cases(2, false);
    ASSERT_EQ(a.size(), same.size());
    std::set<std::string> uris, sensors, whats;
    for (size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].uri, same[i].uri);
        EXPECT_NE(a[i].uri, other[i].uri);
        uris.insert(a[i].uri);
        sensors.insert(a[i].sensor);
        whats.insert(a[i].what);
    }
    EXPECT_EQ(uris.size(), a.size());
    EXPECT_EQ(sensors.size(), 2u);
    for (const char* row : {"arms crossed", "sitting down", "seen from behind", "seen from the left"})
        EXPECT_EQ(whats.count(row), 1u) << row;
    EXPECT_EQ(track_cases(1, true).size(), 6 * a.size());
}

}  // namespace
}  // namespace vfit::tools
