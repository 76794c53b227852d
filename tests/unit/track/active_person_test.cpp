// Whom the room serves: the rule, patience with those who pass by, waiting for those who are out of sight.
#include "track/active_person.h"

#include <gtest/gtest.h>

#include <vector>

namespace vfit {
namespace {

constexpr int64_t kFrame_ns = 33'333'333;

/// Somebody whose trunk is there in the world; the camera looks along -z.
Body person(uint32_t id, float x, float distance) {
    Body body;
    body.id = id;
    for (const int joint : {VFIT_JOINT_TORSO, VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP})
        body.set(joint, {x, 1.0f, -distance});
    return body;
}

class ActivePersonTest : public ::testing::Test {
protected:
    ActiveBody step(const std::vector<Body>& bodies) {
        return active.update(time += kFrame_ns, bodies, Camera());
    }
    ActiveBody steps(int count, const std::vector<Body>& bodies) {
        ActiveBody last;
        for (int i = 0; i < count; ++i) last = step(bodies);
        return last;
    }
    /// Frames until somebody else is active.
    int frames_until(uint32_t id, const std::vector<Body>& bodies) {
        for (int i = 1; i < 200; ++i)
            if (step(bodies).id == id) return i;
        return -1;
    }
    ActivePerson active;
    int64_t time = 0;
};

TEST_F(ActivePersonTest, NobodyIsServedInAnEmptyRoom) {
    EXPECT_EQ(step({}).id, 0u);
    EXPECT_EQ(step({}).state, VFIT_ACTIVE_NOBODY);
}

TEST_F(ActivePersonTest, TheNearestIsServedWhateverTheOrder) {
    const ActiveBody served = step({person(1, 0.0f, 3.0f), person(2, 1.0f, 1.8f)});
    EXPECT_EQ(served.id, 2u);
    EXPECT_EQ(served.state, VFIT_ACTIVE_BY_RULE);
}

TEST_F(ActivePersonTest, TheMostCentredIsServedWhereThatIsTheRule) {
    active = ActivePerson(VFIT_FOLLOW_CENTRED);
    EXPECT_EQ(step({person(1, -0.9f, 1.2f), person(2, 0.3f, 3.0f)}).id, 2u);
}

TEST_F(ActivePersonTest, WhoCameFirstStaysWhereThatIsTheRule) {
    active = ActivePerson(VFIT_FOLLOW_FIRST);
    step({person(4, 0.0f, 3.0f)});
    EXPECT_EQ(steps(120, {person(2, 0.0f, 1.0f), person(4, 0.0f, 3.0f)}).id, 4u);
    // Gone for good: of the others the one who came first.
    steps(10, {person(2, 0.0f, 1.0f), person(1, 0.0f, 0.9f)});
    EXPECT_EQ(steps(120, {person(1, 0.0f, 0.9f), person(2, 0.0f, 1.0f)}).id, 2u);
}

TEST_F(ActivePersonTest, TwoSideBySideDoNotTakeTurns) {
    const uint32_t first = step({person(1, -0.4f, 2.0f), person(2, 0.4f, 2.05f)}).id;
    for (int i = 0; i < 300; ++i) {
        const float sway = i % 2 ? 0.14f : -0.14f;
        ASSERT_EQ(step({person(1, -0.4f, 2.0f + sway), person(2, 0.4f, 2.0f - sway)}).id, first) << i;
    }
}

TEST_F(ActivePersonTest, SomebodyWhoPassesBeforeTheMirrorDoesNotTakeItOver) {
    step({person(1, 0.0f, 2.5f)});
    EXPECT_EQ(steps(25, {person(1, 0.0f, 2.5f), person(2, 0.0f, 1.0f)}).id, 1u);
    EXPECT_EQ(steps(5, {person(1, 0.0f, 2.5f)}).id, 1u);
    EXPECT_EQ(steps(25, {person(1, 0.0f, 2.5f), person(3, 0.0f, 1.0f)}).id, 1u);
}

TEST_F(ActivePersonTest, WhoStepsBeforeTheOtherAndStaysIsServedAfterASecond) {
    step({person(1, 0.0f, 2.5f)});
    const int frames = frames_until(2, {person(1, 0.0f, 2.5f), person(2, 0.3f, 1.5f)});
    EXPECT_NEAR(float(frames) / 30.0f, ActivePerson::kPatience_s, 0.1f);
}

TEST_F(ActivePersonTest, TwoWhoAreBothNearerDoNotKeepEachOtherOut) {
    step({person(1, 0.0f, 3.0f)});
    uint32_t served = 1;
    for (int i = 0; i < 40; ++i) {
        const float sway = i % 2 ? 0.1f : -0.1f;
        served =
            step({person(1, 0.0f, 3.0f), person(2, 0.5f, 1.5f + sway), person(3, -0.5f, 1.5f - sway)}).id;
    }
    EXPECT_NE(served, 1u);
}

TEST_F(ActivePersonTest, SomebodyOutOfSightIsWaitedFor) {
    step({person(1, 0.0f, 2.0f)});
    const std::vector<Body> other = {person(2, 0.5f, 3.0f)};
    ActiveBody served = steps(50, other);
    EXPECT_EQ(served.id, 1u);
    EXPECT_EQ(served.state, VFIT_ACTIVE_LOST);
    served = step({person(1, 0.0f, 2.0f), other[0]});
    EXPECT_EQ(served.id, 1u);
    EXPECT_EQ(served.state, VFIT_ACTIVE_BY_RULE);
    EXPECT_NEAR(float(frames_until(2, other)) / 30.0f, ActivePerson::kWait_s, 0.1f);
}

TEST_F(ActivePersonTest, NobodyTakesOverWhereNobodyIs) {
    step({person(1, 0.0f, 2.0f)});
    EXPECT_EQ(steps(30, {}).state, VFIT_ACTIVE_LOST);
    EXPECT_EQ(steps(60, {}).state, VFIT_ACTIVE_NOBODY);
    EXPECT_EQ(step({person(2, 0.0f, 2.0f)}).id, 2u);
}

TEST_F(ActivePersonTest, TheChosenIsServedAtOnceAndAgainstTheRule) {
    const std::vector<Body> both = {person(1, 0.0f, 1.5f), person(2, 1.0f, 3.5f)};
    step(both);
    active.choose(2);
    EXPECT_EQ(step(both).id, 2u);
    EXPECT_EQ(steps(200, both).state, VFIT_ACTIVE_CHOSEN);
    active.choose(0);
    EXPECT_EQ(step(both).state, VFIT_ACTIVE_BY_RULE);
    EXPECT_EQ(step(both).id, 2u) << "they were served, and nobody has waited a second";
    EXPECT_EQ(steps(40, both).id, 1u);
}

TEST_F(ActivePersonTest, TheRuleTakesOverWhenTheChosenHasLeft) {
    active.choose(2);
    EXPECT_EQ(step({person(1, 0.0f, 1.5f), person(2, 1.0f, 3.5f)}).id, 2u);
    const std::vector<Body> left = {person(1, 0.0f, 1.5f)};
    EXPECT_EQ(step(left).state, VFIT_ACTIVE_LOST);
    EXPECT_NEAR(float(frames_until(1, left)) / 30.0f, ActivePerson::kWait_s, 0.1f);
    // Who comes back is a guest like any other.
    EXPECT_EQ(step({left[0], person(2, 1.0f, 3.5f)}).id, 1u);
}

TEST_F(ActivePersonTest, AChoiceOfNobodyInViewIsGivenUp) {
    steps(3, {person(1, 0.0f, 1.5f)});
    active.choose(77);
    EXPECT_EQ(step({person(1, 0.0f, 1.5f)}).state, VFIT_ACTIVE_LOST);
    EXPECT_EQ(steps(70, {person(1, 0.0f, 1.5f)}).id, 1u);
}

TEST_F(ActivePersonTest, NobodyButTheChosenIsServedWhereThatIsTheRule) {
    active = ActivePerson(VFIT_FOLLOW_CHOSEN);
    EXPECT_EQ(step({person(1, 0.0f, 1.5f)}).id, 0u);
    active.choose(2);
    EXPECT_EQ(steps(300, {person(1, 0.0f, 1.5f)}).state, VFIT_ACTIVE_LOST);
    EXPECT_EQ(step({person(1, 0.0f, 1.5f), person(2, 0.0f, 3.0f)}).state, VFIT_ACTIVE_CHOSEN);
    EXPECT_EQ(steps(300, {person(1, 0.0f, 1.5f)}).id, 2u) << "for ever";
}

TEST_F(ActivePersonTest, BodiesOfOneMomentMayComeOneByOne) {
    const std::vector<Body> both = {person(1, 0.0f, 2.5f), person(2, 0.5f, 1.5f)};
    time = kFrame_ns;
    active.update(time, std::span(both).first(1), Camera());
    EXPECT_EQ(active.update(time, both, Camera()).id, 2u);
    for (int i = 0; i < 100; ++i) {
        time += kFrame_ns;
        EXPECT_EQ(active.update(time, std::span(both).first(1), Camera()).id, 2u);
        EXPECT_EQ(active.update(time, both, Camera()).state, VFIT_ACTIVE_BY_RULE);
    }
}

TEST_F(ActivePersonTest, ARecordingThatIsPlayedAgainKeepsItsPerson) {
    const std::vector<Body> both = {person(1, 0.0f, 2.0f), person(2, 0.5f, 2.1f)};
    steps(90, both);
    time = -90 * kFrame_ns;
    EXPECT_EQ(step(both).id, 1u);
    EXPECT_EQ(steps(20, {both[1]}).state, VFIT_ACTIVE_LOST);
    EXPECT_EQ(steps(60, {both[1]}).id, 2u);
}

TEST_F(ActivePersonTest, ResetForgetsPersonAndChoice) {
    active.choose(2);
    step({person(2, 0.0f, 3.0f)});
    active.reset();
    EXPECT_EQ(step({person(1, 0.0f, 1.5f), person(2, 0.0f, 3.0f)}).id, 1u);
}

}  // namespace
}  // namespace vfit
