// A turn that is tracked smoothly is shown as it is; one that jumps is caught up with.
#include "motion/bounded_turn.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/quaternion.h"

namespace vfit {
namespace {

constexpr float kStepS = 1.0f / 30.0f, kMost = 60.0f;

Quat turned_to(float rad) { return glm::angleAxis(rad, glm::normalize(Vec3(0.3f, 1.0f, -0.2f))); }

TEST(BoundedTurn, ShowsASwingThatPeopleCanDoAsItIs) {
    BoundedTurn turn;
    float farthest = 0.0f;
    for (int i = 0; i < 120; ++i) {
        const Quat tracked =
            turned_to(0.8f * (1.0f - std::cos(2.0f * kPi * 0.8f * float(i) * kStepS)));  // 20 rad/s^2
        farthest =
            std::max(farthest, angle_of(turn.follow(tracked, kMost, kStepS) * glm::conjugate(tracked)));
    }
    EXPECT_LT(farthest, 1e-3f);
}

TEST(BoundedTurn, CatchesUpWithAJumpAtNoMoreThanItsAcceleration) {
    for (const float step_s : {1.0f / 30.0f, 1.0f / 600.0f, 0.5f}) {
        BoundedTurn turn;
        turn.follow(turned_to(0.0f), kMost, step_s);
        float angle = 0.0f, speed = 0.0f, farthest = 0.0f;
        for (float t = 0.0f; t < 1.5f; t += step_s) {
            const Quat shown = turn.follow(turned_to(0.5f), kMost, step_s);
            const float now = angle_of(shown), now_speed = (now - angle) / step_s;
            EXPECT_LT(std::abs(now_speed - speed) / step_s, kMost * 1.05f) << t;
            angle = now, speed = now_speed, farthest = std::max(farthest, now);
        }
        EXPECT_NEAR(angle, 0.5f, 0.002f) << step_s;
        EXPECT_LT(farthest, 0.505f) << step_s;
    }
}

TEST(BoundedTurn, GoesOnFromWhereSomethingElseTurnedItAtThatSpeed) {
    BoundedTurn turn;
    for (int i = 0; i <= 10; ++i) turn.set(turned_to(0.05f * float(i)), kStepS);  // 1.5 rad/s
    const Quat shown = turn.follow(turned_to(0.5f), kMost, kStepS);
    EXPECT_NEAR(angle_of(shown), 0.5f, 0.06f);
    EXPECT_EQ(turn.follow(turned_to(2.0f), kMost, 0.0f), shown) << "no time has passed";
}

}  // namespace
}  // namespace vfit
