// Scripted motions of single steps: jump (on the spot, both feet leave the floor), step (aside, forwards and
// back) and balance (one foot is held up, then the other).
#include "keys.h"
#include "motion.h"

namespace vfit::virtual_person {

namespace {

constexpr float kGravity = 9.81f;
constexpr float kHeight_m = 0.15f, kCrouch_m = 0.20f;
const float kSpeed = std::sqrt(2.0f * kGravity * kHeight_m);  // at take-off and landing
const float kFlight_s = 2.0f * kSpeed / kGravity;
const float kPush_s =
    2.0f * kCrouch_m / kSpeed;  // from the crouch at an even acceleration; the landing likewise
constexpr float kSink_s = 0.6f, kRise_s = 0.8f, kStart_s = 0.5f, kJump_s = 3.0f;

struct JumpState {
    float drop_m = 0, lift_m = 0;
    bool flies = false;
};

/// t from the beginning of the crouch.
JumpState jump_at(float t) {
    JumpState s;
    if (t < 0.0f) return s;
    if (t < kSink_s) {
        s.drop_m = kCrouch_m * ease(t / kSink_s);
        return s;
    }
    t -= kSink_s;
    if (t < kPush_s) {
        s.drop_m = kCrouch_m * (1.0f - (t / kPush_s) * (t / kPush_s));
        return s;
    }
    t -= kPush_s;
    if (t < kFlight_s) {
        s.lift_m = kSpeed * t - 0.5f * kGravity * t * t;
        s.flies = true;
        return s;
    }
    t -= kFlight_s;
    if (t < kPush_s) {
        const float left = 1.0f - t / kPush_s;
        s.drop_m = kCrouch_m * (1.0f - left * left);
        return s;
    }
    s.drop_m = kCrouch_m * (1.0f - ease((t - kPush_s) / kRise_s));
    return s;
}

}  // namespace

Script jump_script() {
    return {[](float t) {
                const JumpState jump = jump_at(std::fmod(t, kJump_s) - kStart_s);
                Figure f = standing();
                for (FootState& foot : f.foot) foot.lift_m = jump.lift_m, foot.planted = !jump.flies;
                f.drop_m = 0.004f + jump.drop_m;
                const float bend = jump.drop_m / kCrouch_m;
                set_trunk(f, 18.0f * bend, 0, 0);
                f.pelvis = rotate_x(20.0f * bend);
                for (const int side : {kLeft, kRight})
                    set_arm(f.rotation, side,
                            {12 + 20 * bend, -25 * bend + 60 * jump.lift_m / kHeight_m, 20 + 30 * bend, 0});
                return f;
            },
            2 * kJump_s};
}

// To the left and back, forwards and back: each foot steps and stands, the body rests between.
Script step_script() {
    constexpr float apart_m = 0.22f, swing_s = 0.40f, step_s = 0.5f, pair_s = 2.0f;
    const Vec2 places[] = {{0.30f, 0}, {0, 0}, {0, 0.35f}, {0, 0}};
    std::vector<Step> steps;
    for (int pair = 0; pair < 4; ++pair)
        for (int i = 0; i < 2; ++i) {
            Step step;
            // The foot on the side where it goes steps first.
            step.side = (i == 0) == (pair != 1) ? kLeft : kRight;
            step.lift_s = pair_s * static_cast<float>(pair) + 0.4f + step_s * static_cast<float>(i);
            step.land_s = step.lift_s + swing_s;
            step.to = stand(places[pair], 0, apart_m)[static_cast<size_t>(step.side)];
            step.clearance_m = 0.04f, step.heel_rad = 0.2f;
            steps.push_back(step);
        }
    const auto feet = stand({0, 0}, 0, apart_m);
    const StepPlan plan(feet[0], feet[1], std::move(steps));
    return {[plan](float t) {
                Figure f;
                place_feet(f, plan, t);
                f.root = plan.root(t);
                for (const int side : {kLeft, kRight}) set_arm(f.rotation, side, {14, 4, 16, 0});
                return f;
            },
            4 * pair_s};
}

Script balance_script() {
    constexpr float height_m = 0.18f, side_s = 3.5f;
    return {[](float t) {
                Figure f = standing();
                const int side = t < side_s ? kLeft : kRight;
                const float u = t < side_s ? t : t - side_s;
                const float weight = track({{0, 0}, {0.6f, 1}, {2.7f, 1}, {3.3f, 0}}, u);
                const float up = track({{0.5f, 0}, {1.0f, 1}, {2.3f, 1}, {2.8f, 0}}, u);
                FootState& foot = f.foot[static_cast<size_t>(side)];
                foot.planted = up <= 0.0f;
                foot.lift_m = height_m * up;
                foot.heel_rad = 0.5f * up;
                f.root.x = -side_sign(side) * 0.085f * weight;
                f.pelvis = rotate_z(2.0f * side_sign(side) * weight);
                for (const int arm : {kLeft, kRight}) set_arm(f.rotation, arm, {12 + 25 * weight, 3, 14, 0});
                return f;
            },
            2 * side_s};
}

}  // namespace vfit::virtual_person
