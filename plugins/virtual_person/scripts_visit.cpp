// The scripted motion visit: the person comes in from the image's right, turns to the camera, stands for a
// while and goes out the way they came; outside they turn round, so that the round can begin again.
#include <algorithm>
#include <cmath>

#include "keys.h"
#include "motion.h"

namespace vfit::virtual_person {

namespace {

// Out of every sensor's view where people stand (half a field of 70 degrees at 3.4 m, and half a person).
constexpr float kOutside_m = 2.9f;
constexpr int kSteps = 8;  // of one way
constexpr float kStep_s = 0.55f, kSwing_s = 0.42f;
constexpr float kHalfWidth_m = 0.1f;
constexpr float kWait_s = 0.5f, kStand_s = 2.0f;
constexpr float kWay_s = kStep_s * (kSteps + 1.5f), kTurn_s = 2.1f, kTurnRound_s = 3.9f;
// When each part begins.
constexpr float kIn = kWait_s, kTurnIn = kIn + kWay_s, kStanding = kTurnIn + kTurn_s,
                kTurnOut = kStanding + kStand_s, kOut = kTurnOut + kTurn_s, kTurnRound = kOut + kWay_s,
                kEnd = kTurnRound + kTurnRound_s;

/// 0 to 1 over the steps of one way: even in the middle, eased over a step and a half at both ends.
float way(float t) {
    constexpr float total = kStep_s * kSteps, ramp = 1.5f * kStep_s, speed = 1.0f / (total - ramp);
    t = std::clamp(t, 0.0f, total);
    if (t < ramp) return 0.5f * speed * t * t / ramp;
    if (t > total - ramp) return 1.0f - 0.5f * speed * (total - t) * (total - t) / ramp;
    return speed * (t - 0.5f * ramp);
}

float x_at(float t) { return t < kOut ? kOutside_m * (1.0f - way(t - kIn)) : kOutside_m * way(t - kOut); }

Foothold walking(int side, float x, float heading) {
    const Vec2 left(std::cos(heading), -std::sin(heading));
    return {Vec2(x, 0) + left * (side_sign(side) * kHalfWidth_m), heading + side_sign(side) * 0.1f};
}

// A foot lands where the body is in the middle of the other one's swing.
void add_way(float begin_s, float heading, std::vector<Step>& steps) {
    for (int i = 0; i <= kSteps; ++i) {
        Step step;
        step.side = i % 2 == 0 ? kLeft : kRight;
        step.lift_s = begin_s + kStep_s * static_cast<float>(i) + (kStep_s - kSwing_s) / 2;
        step.land_s = step.lift_s + kSwing_s;
        step.to = walking(step.side, x_at(begin_s + kStep_s * (static_cast<float>(i) + 1.5f)), heading);
        step.heel_rad = 0.4f;
        steps.push_back(step);
    }
}

// On the spot at `x`, by `pairs` steps of each foot.
void add_turn(float begin_s, float x, float from, float to, int pairs, std::vector<Step>& steps) {
    for (int i = 0; i < 2 * pairs; ++i) {
        Step step;
        step.side = (i % 2 == 0) == (to > from) ? kLeft : kRight;
        step.lift_s = begin_s + 0.1f + 0.45f * static_cast<float>(i), step.land_s = step.lift_s + 0.4f;
        const float share = static_cast<float>(i / 2 + 1) / static_cast<float>(pairs);
        step.to = walking(step.side, x, from + (to - from) * share);
        step.heel_rad = 0.25f;
        steps.push_back(step);
    }
}

}  // namespace

Script visit_script() {
    constexpr float inwards = -kPi / 2, outwards = kPi / 2;
    std::vector<Step> steps;
    add_way(kIn, inwards, steps);
    add_turn(kTurnIn, 0, inwards, 0, 2, steps);
    add_turn(kTurnOut, 0, 0, outwards, 2, steps);
    add_way(kOut, outwards, steps);
    add_turn(kTurnRound, kOutside_m, outwards, inwards + 2 * kPi, 4, steps);
    const StepPlan plan(walking(kLeft, kOutside_m, inwards), walking(kRight, kOutside_m, inwards),
                        std::move(steps));
    return {
        [plan](float t) {
            Figure f;
            place_feet(f, plan, t);
            f.heading_rad = plan.heading_rad(t);
            const bool on_way = t < kTurnIn || (t > kOut && t < kTurnRound);
            f.root = on_way ? Vec2(x_at(t), 0) : plan.root(t);
            const float since = t < kTurnIn ? t - kIn : t - kOut;
            const float walking_now =
                on_way
                    ? track({{0, 0}, {kStep_s, 1}, {kStep_s * kSteps, 1}, {kStep_s * (kSteps + 1), 0}}, since)
                    : 0.0f;
            const float stride = -walking_now * std::cos(kPi / kStep_s * since);  // 1: the left foot is ahead
            f.pelvis = rotate_y(-4.0f * stride);
            f.drop_m = 0.01f;
            set_trunk(f, 2, 0, 7.0f * stride);
            for (const int side : {kLeft, kRight})
                set_arm(f.rotation, side,
                        {12, 4 - 20 * side_sign(side) * stride, 16 - 6 * side_sign(side) * stride, 0});
            return f;
        },
        kEnd};
}

}  // namespace vfit::virtual_person
