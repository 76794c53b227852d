// Joints that vanish, hold and come back; prediction between bodies.
#include "motion/body_filter.h"

#include <gtest/gtest.h>

#include "motion_support.h"

namespace vfit {
namespace {

using testing::frame_ns;

constexpr int kHand = VFIT_JOINT_LEFT_HAND;

Body with_hand(float x, int64_t time_ns, vfit_joint_state state = VFIT_JOINT_MEASURED) {
    Body body;
    body.time_ns = time_ns;
    if (state != VFIT_JOINT_NOT_SEEN) body.set(kHand, {x, 0, 0}, state);
    return body;
}

struct MovingHand {
    BodyFilter filter;
    PositionFilterSettings settings;
    Body out;
    int frame = 0;

    MovingHand() {
        settings.kind = VFIT_POSITION_HOLT;
        for (; frame < 60; ++frame) filter.update(with_hand(place(frame), frame_ns(frame)), &settings);
    }
    static float place(int frame) { return 0.01f * static_cast<float>(frame); }  // 0.3 m/s
    float shown(int64_t time_ns) {
        filter.sample(time_ns, out);
        return out.at(kHand).x;
    }
};

TEST(BodyFilter, PredictsBetweenBodies) {
    MovingHand hand;
    const int64_t last = frame_ns(59);
    const float now = hand.shown(last), later = hand.shown(last + 16'666'667);
    EXPECT_NEAR(later - now, 0.005f, 0.001f);  // half a frame of 0.3 m/s
}

TEST(BodyFilter, LosesAJointAlongItsTrendAndThenHolds) {
    MovingHand hand;
    const float at_loss = hand.shown(frame_ns(59));
    float before = at_loss;
    for (int f = 60; f < 120; ++f) {
        hand.filter.update(with_hand(0, frame_ns(f), VFIT_JOINT_NOT_SEEN), &hand.settings);
        const float x = hand.shown(frame_ns(f));
        EXPECT_GE(x, before - 1e-5f);
        before = x;
        EXPECT_EQ(hand.out.joints[kHand].state, VFIT_JOINT_INFERRED);
    }
    EXPECT_NEAR(before - at_loss, 0.3f * BodyFilter::kTrendTimeS, 0.004f);
    EXPECT_NEAR(hand.shown(frame_ns(119) + 1'000'000'000), before, 1e-5f);
}

TEST(BodyFilter, BringsALostJointBackWithoutAJump) {
    MovingHand hand;
    for (int f = 60; f < 90; ++f)
        hand.filter.update(with_hand(0, frame_ns(f), VFIT_JOINT_NOT_SEEN), &hand.settings);
    const float before = hand.shown(frame_ns(89));
    const float target = before + 0.4f;
    float last = before;
    for (int f = 90; f < 150; ++f) {
        hand.filter.update(with_hand(target, frame_ns(f)), &hand.settings);
        const float x = hand.shown(frame_ns(f));
        EXPECT_LT(std::abs(x - last), 0.1f) << f;  // a quarter of the distance a frame
        last = x;
    }
    EXPECT_NEAR(last, target, 0.002f);
}

TEST(BodyFilter, TrustsALostJointLessAndLessAndOneThatReturnsMoreAndMore) {
    MovingHand hand;
    hand.shown(frame_ns(59));
    EXPECT_EQ(hand.out.joints[kHand].confidence, 1.0f);
    float before = 1.0f;
    for (int f = 60; f < 90; ++f) {
        hand.filter.update(with_hand(0, frame_ns(f), VFIT_JOINT_NOT_SEEN), &hand.settings);
        hand.shown(frame_ns(f));
        EXPECT_LT(hand.out.joints[kHand].confidence, before) << f;
        before = hand.out.joints[kHand].confidence;
    }
    EXPECT_NEAR(before, std::exp(-2.0f), 0.02f);  // a second later
    for (int f = 90; f < 120; ++f) {
        hand.filter.update(with_hand(0.9f, frame_ns(f)), &hand.settings);
        hand.shown(frame_ns(f));
        // On the frame of its return it is as trusted as it would be if it were still lost.
        EXPECT_GE(hand.out.joints[kHand].confidence, before - 0.01f) << f;
        EXPECT_LT(hand.out.joints[kHand].confidence, before + 0.3f) << f;
        before = hand.out.joints[kHand].confidence;
    }
    EXPECT_GT(before, 0.99f);
}

TEST(BodyFilter, TwoReadingsOfOneMomentDoNotThrowTheJoint) {
    BodyFilter filter;
    PositionFilterSettings raw;  // the trend as it is read
    raw.kind = VFIT_POSITION_HOLT;
    raw.holt.smoothing = 0.0f;
    raw.holt.correction = 1.0f;
    Body out;
    filter.update(with_hand(0.0f, 0), &raw);
    filter.update(with_hand(0.01f, 1'000), &raw);  // a centimetre in a microsecond
    filter.sample(100'000'000, out);
    EXPECT_LT(std::abs(out.at(kHand).x), 1.0f);
}

TEST(BodyFilter, PassesReadingsThroughWithoutSettings) {
    BodyFilter filter;
    Body out;
    for (int f = 0; f < 5; ++f) {
        filter.update(with_hand(f == 3 ? 7.0f : 1.0f, frame_ns(f)), nullptr);
        filter.sample(frame_ns(f), out);
        EXPECT_FLOAT_EQ(out.at(kHand).x, f == 3 ? 7.0f : 1.0f);
    }
    EXPECT_FALSE(out.has(VFIT_JOINT_HEAD));
}

}  // namespace
}  // namespace vfit
