// Scripted motions of quick feet on one spot: spin and round (once round without a stop) and jog.
#include <cmath>

#include "keys.h"
#include "motion.h"

namespace vfit::virtual_person {

namespace {

/// Small steps round on the spot to the right, each foot once per `step_s` in turn.
StepPlan round_steps(int pairs, float step_s, float swing_s, float apart_m) {
    std::vector<Step> steps;
    for (int i = 0; i < 2 * pairs; ++i) {
        Step step;
        step.side = i % 2 == 0 ? kRight : kLeft;
        step.lift_s = step_s * static_cast<float>(i) + (step_s - swing_s) / 2,
        step.land_s = step.lift_s + swing_s;
        const float heading = -2.0f * kPi * static_cast<float>(i / 2 + 1) / static_cast<float>(pairs);
        step.to = stand({0, 0}, heading, apart_m)[static_cast<size_t>(step.side)];
        step.heel_rad = 0.2f;
        steps.push_back(step);
    }
    const auto feet = stand({0, 0}, 0, apart_m);
    return {feet[0], feet[1], std::move(steps)};
}

Figure on_steps(const StepPlan& plan, float t) {
    Figure f;
    place_feet(f, plan, t);
    f.root = plan.root(t);
    f.heading_rad = plan.heading_rad(t);
    f.drop_m = 0.006f;
    return f;
}

}  // namespace

// To the right, 45 degrees by each pair of steps, round in 7.2 s.
Script spin_script() {
    constexpr float step_s = 0.45f;
    constexpr int pairs = 8;
    return {[plan = round_steps(pairs, step_s, 0.38f, 0.24f)](float t) {
                Figure f = on_steps(plan, t);
                for (const int side : {kLeft, kRight})
                    set_arm(f.rotation, side, {20, 4, 20 + 6 * wave(1.0f / (2 * step_s), t), 0});
                return f;
            },
            step_s * 2 * pairs};
}

// As an all-round scan asks for: arms held out, 30 degrees by each pair of steps, round in 9.6 s.
Script round_script(float arms_deg) {
    constexpr float step_s = 0.40f;
    constexpr int pairs = 12;
    return {[arms_deg, plan = round_steps(pairs, step_s, 0.30f, 0.25f)](float t) {
                Figure f = on_steps(plan, t);
                for (const int side : {kLeft, kRight})
                    set_arm(f.rotation, side, {arms_deg + 2 * wave(1.0f / (2 * step_s), t), 0, 6, 0});
                return f;
            },
            step_s * 2 * pairs};
}

// On the spot, one foot always on the floor, forearms level and swinging against the legs.
Script jog_script() {
    constexpr float step_s = 0.44f, swing_s = 0.40f;
    constexpr int step_count = 10;
    std::vector<Step> steps;
    for (int i = 0; i < step_count; ++i) {
        Step step;
        step.side = i % 2 == 0 ? kLeft : kRight;
        step.lift_s = step_s * static_cast<float>(i) + (step_s - swing_s) / 2,
        step.land_s = step.lift_s + swing_s;
        step.to = stand({0, 0}, 0, 0.2f)[static_cast<size_t>(step.side)];
        step.clearance_m = 0.10f, step.heel_rad = 0.4f;
        steps.push_back(step);
    }
    const auto feet = stand({0, 0}, 0, 0.2f);
    const StepPlan plan(feet[0], feet[1], std::move(steps));
    return {[plan](float t) {
                Figure f;
                place_feet(f, plan, t);
                const float left_swings = wave(0.5f / step_s, t);
                f.root = {-0.025f * left_swings, 0.02f};
                f.drop_m = 0.04f - 0.012f * std::cos(4.0f * kPi * 0.5f / step_s * t);
                f.pelvis = rotate_z(-2.0f * left_swings);
                set_trunk(f, 5, 2.0f * left_swings, 6.0f * left_swings);
                for (const int side : {kLeft, kRight})
                    set_arm(f.rotation, side,
                            {14, 5 - 28 * side_sign(side) * left_swings,
                             88 - 10 * side_sign(side) * left_swings, -12});
                return f;
            },
            step_s * step_count};
}

}  // namespace vfit::virtual_person
