// People of a user map get the numbers of the bodies whose joints lie on them.
#include "track/match_bodies.h"

#include <gtest/gtest.h>

#include <vector>

namespace vfit {
namespace {

class MatchBodiesTest : public ::testing::Test {
protected:
    MatchBodiesTest() : users(160 * 120, 0) {
        camera.width = 160, camera.height = 120;
        camera.fx = camera.fy = 100.0f;
        camera.cx = 79.5f, camera.cy = 59.5f;
    }
    /// A person of the map, 20 pixels wide.
    void paint(uint8_t label, int x0) {
        for (int y = 20; y < 100; ++y)
            for (int x = x0; x < x0 + 20; ++x) users[size_t(y * 160 + x)] = label;
        PersonRegion region;
        region.id = label;
        people.push_back(region);
    }
    /// A body with five joints down the column at x, 2 m away.
    Body body(uint32_t id, float x) const {
        Body out;
        out.id = id;
        for (int j = 0; j < 5; ++j) out.set(j, camera.unproject(x, 30.0f + 15.0f * float(j), 2.0f));
        return out;
    }
    uint8_t at(int x) const { return users[size_t(60 * 160 + x)]; }
    void number(const std::vector<Body>& bodies) { number_by_bodies(bodies, camera, people, users.data()); }

    Camera camera;
    std::vector<uint8_t> users;
    std::vector<PersonRegion> people;
};

TEST_F(MatchBodiesTest, EachPersonGetsTheNumberOfTheirBody) {
    paint(1, 20), paint(2, 60), paint(3, 100);
    number({body(3, 30), body(1, 70)});
    EXPECT_EQ(at(30), 3);
    EXPECT_EQ(at(70), 1);
    EXPECT_NE(at(110), 3) << "the number of somebody else";
    EXPECT_NE(at(110), 1);
    EXPECT_NE(at(110), 0);
    EXPECT_EQ(at(0), 0);
}

TEST_F(MatchBodiesTest, ABodyOnNobodyGivesItsNumberToNobody) {
    paint(1, 20);
    number({body(1, 120)});
    EXPECT_NE(at(30), 1);
    EXPECT_NE(at(30), 0);
}

TEST_F(MatchBodiesTest, AMinorityOfJointsIsNotEnough) {
    paint(4, 20);
    Body half = body(2, 30);
    for (int j = 0; j < 3; ++j) half.set(j, camera.unproject(120.0f, 60.0f, 2.0f));
    number({half});
    EXPECT_EQ(at(30), 4);
    // Those outside the image do not count.
    for (int j = 0; j < 3; ++j) half.set(j, camera.unproject(1200.0f, 60.0f, 2.0f));
    number({half});
    EXPECT_EQ(at(30), 2);
}

TEST_F(MatchBodiesTest, TwoBodiesOnOnePersonDoNotShareThem) {
    paint(9, 20);
    number({body(5, 30), body(6, 31)});
    EXPECT_EQ(at(30), 5);
}

TEST_F(MatchBodiesTest, JointsBehindTheCameraAreNowhere) {
    paint(9, 70);
    Body behind;
    behind.id = 5;
    behind.set(VFIT_JOINT_HEAD, {0.0f, 0.0f, -2.0f});
    number({behind});
    EXPECT_EQ(at(79), 9);
}

}  // namespace
}  // namespace vfit
