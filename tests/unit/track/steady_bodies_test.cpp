// Joints of somebody else's middleware: judged by their confidence, steadied, and let go where they were
// away.
#include "track/steady_bodies.h"

#include <gtest/gtest.h>

#include <random>

namespace vfit {
namespace {

constexpr int64_t kStep_ns = 33'333'333;

Body body_at(int64_t time_ns, float hand_x = 0.5f, float confidence = 1.0f) {
    Body body;
    body.id = 1;
    body.time_ns = time_ns;
    body.set(VFIT_JOINT_HEAD, {0.0f, 1.6f, -2.0f});
    body.set(VFIT_JOINT_LEFT_HAND, {hand_x, 1.0f, -2.0f}, VFIT_JOINT_MEASURED, confidence);
    return body;
}

float hand_x(const Body& body) { return body.at(VFIT_JOINT_LEFT_HAND).x; }

TEST(JudgeStates, FollowTheConfidenceDownwards) {
    Body body;
    body.set(VFIT_JOINT_HEAD, {}, VFIT_JOINT_MEASURED, 0.9f);
    body.set(VFIT_JOINT_NECK, {}, VFIT_JOINT_MEASURED, 0.3f);
    body.set(VFIT_JOINT_TORSO, {}, VFIT_JOINT_MEASURED, 0.0f);
    body.set(VFIT_JOINT_LEFT_HIP, {}, VFIT_JOINT_INFERRED, 0.9f);
    body.set(VFIT_JOINT_RIGHT_HIP, {}, VFIT_JOINT_INFERRED, -3.0f);
    body.set(VFIT_JOINT_LEFT_KNEE, {}, VFIT_JOINT_NOT_SEEN, 0.9f);
    body.set(VFIT_JOINT_RIGHT_KNEE, {}, VFIT_JOINT_MEASURED, 80.0f);
    judge_states(body);
    const auto state = [&](int joint) { return body.joints[size_t(joint)].state; };
    EXPECT_EQ(state(VFIT_JOINT_HEAD), VFIT_JOINT_MEASURED);
    EXPECT_EQ(state(VFIT_JOINT_NECK), VFIT_JOINT_INFERRED);
    EXPECT_EQ(state(VFIT_JOINT_TORSO), VFIT_JOINT_NOT_SEEN);
    EXPECT_EQ(state(VFIT_JOINT_LEFT_HIP), VFIT_JOINT_INFERRED)
        << "what the middleware only infers is not measured";
    EXPECT_EQ(state(VFIT_JOINT_RIGHT_HIP), VFIT_JOINT_NOT_SEEN);
    EXPECT_EQ(state(VFIT_JOINT_LEFT_KNEE), VFIT_JOINT_NOT_SEEN);
    EXPECT_EQ(body.joints[VFIT_JOINT_RIGHT_KNEE].confidence, 1.0f);
}

TEST(JudgeStates, StandForTheConfidenceWhereThereIsNone) {
    Body body;
    body.set(VFIT_JOINT_HEAD, {}, VFIT_JOINT_MEASURED, 0.0f);
    body.set(VFIT_JOINT_NECK, {}, VFIT_JOINT_INFERRED, 0.0f);
    judge_states(body);
    EXPECT_EQ(body.joints[VFIT_JOINT_HEAD].state, VFIT_JOINT_MEASURED);
    EXPECT_EQ(body.joints[VFIT_JOINT_HEAD].confidence, 1.0f);
    EXPECT_EQ(body.joints[VFIT_JOINT_NECK].state, VFIT_JOINT_INFERRED);
}

TEST(SteadyBodies, TheFirstPlaceIsTakenAsItIs) {
    SteadyBodies steady;
    Body body = body_at(kStep_ns);
    steady.run(body);
    EXPECT_EQ(hand_x(body), 0.5f);
}

TEST(SteadyBodies, TremblingShrinksAndAJumpIsHeldBack) {
    SteadyBodies steady;
    std::mt19937 random(1);
    double before = 0.0, after = 0.0;
    int64_t time = 0;
    for (int frame = 0; frame < 200; ++frame) {
        const float noise = 0.02f * (float(random()) / float(std::mt19937::max()) - 0.5f);
        Body body = body_at(time += kStep_ns, 0.5f + noise);
        steady.run(body);
        if (frame < 20) continue;
        before += double(noise) * noise;
        after += double(hand_x(body) - 0.5f) * (hand_x(body) - 0.5f);
    }
    EXPECT_LT(after, 0.5 * before);
    // One wrong frame of low confidence, then back.
    Body body = body_at(time += kStep_ns, 1.5f, 0.16f);
    steady.run(body);
    EXPECT_LT(hand_x(body), 0.8f);
}

TEST(SteadyBodies, AJointThatWasNotSeenStartsWhereItIsSeenAgain) {
    SteadyBodies steady;
    int64_t time = 0;
    for (int frame = 0; frame < 10; ++frame) {
        Body body = body_at(time += kStep_ns);
        steady.run(body);
    }
    for (int frame = 0; frame < 20; ++frame) {
        Body body = body_at(time += kStep_ns, 0.0f, 0.0f);
        steady.run(body);
        EXPECT_FALSE(body.has(VFIT_JOINT_LEFT_HAND));
    }
    Body body = body_at(time += kStep_ns, 1.0f);
    steady.run(body);
    EXPECT_EQ(hand_x(body), 1.0f);
}

TEST(SteadyBodies, APauseAndAnEarlierTimeStartAfresh) {
    SteadyBodies steady;
    for (const int64_t next : {10 * kStep_ns, 11 * kStep_ns, 30 * kStep_ns, 29 * kStep_ns, 1000 * kStep_ns,
                               int64_t(0), INT64_MAX, INT64_MIN}) {
        Body body = body_at(next, float(next % 7));
        steady.run(body);
        if (next != 11 * kStep_ns) {
            EXPECT_EQ(hand_x(body), float(next % 7)) << next;
        }
    }
}

TEST(SteadyBodies, PeopleDoNotPullAtEachOther) {
    SteadyBodies steady;
    for (int frame = 1; frame < 50; ++frame) {
        Body one = body_at(frame * kStep_ns, 0.5f), two = body_at(frame * kStep_ns, -0.5f);
        two.id = 2;
        steady.run(one);
        steady.run(two);
        ASSERT_EQ(hand_x(one), 0.5f);
        ASSERT_EQ(hand_x(two), -0.5f);
    }
}

}  // namespace
}  // namespace vfit
