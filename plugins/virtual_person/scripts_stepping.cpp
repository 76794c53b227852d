// Scripted motions that step: turn (four quarter turns on the spot) and walk (a small circle).
#include <cmath>

#include "keys.h"
#include "motion.h"

namespace vfit::virtual_person {

// A quarter turn to the left is four steps of 0.45 s, then a second of standing still.
Script turn_script() {
    constexpr float apart_m = 0.22f, swing_s = 0.45f, step_s = 0.5f, quarter_s = 3.2f, start_s = 0.6f;
    std::vector<Step> steps;
    for (int quarter = 0; quarter < 4; ++quarter) {
        for (int i = 0; i < 4; ++i) {
            const float heading = kPi / 2 * (static_cast<float>(quarter) + (i < 2 ? 0.5f : 1.0f));
            const float lift =
                start_s + quarter_s * static_cast<float>(quarter) + step_s * static_cast<float>(i);
            Step step;
            step.side = i % 2 == 0 ? kLeft : kRight;
            step.lift_s = lift, step.land_s = lift + swing_s;
            step.to = stand({0, 0}, heading, apart_m)[static_cast<size_t>(step.side)];
            step.heel_rad = 0.25f;
            steps.push_back(step);
        }
    }
    const auto feet = stand({0, 0}, 0, apart_m);
    const StepPlan plan(feet[0], feet[1], std::move(steps));
    return {[plan](float t) {
                Figure f;
                place_feet(f, plan, t);
                f.root = plan.root(t);
                f.heading_rad = plan.heading_rad(t);
                // The head looks where the turn goes before the feet get there.
                const float ahead =
                    glm::degrees(plan.heading_rad(std::min(t + 0.3f, 4 * quarter_s)) - f.heading_rad);
                f.rotation[VFIT_BONE_NECK] = rotate_y(0.5f * ahead);
                for (const int side : {kLeft, kRight}) set_arm(f.rotation, side, {16, 4, 16, 0});
                return f;
            },
            4 * quarter_s};
}

// Eight steps round a circle to the left, at 0.6 m/s: slow enough for a shop, long enough for heels to rise.
// The circle lies about the place where the other motions stand.
Script walk_script() {
    constexpr int step_count = 8;
    constexpr float radius_m = 0.45f, half_width_m = 0.10f, step_s = 0.58f, swing_s = 0.42f;
    constexpr float period_s = step_count * step_s, turn_rate = 2.0f * kPi / period_s;
    // The centre lies on the person's left; the heading is the angle.
    const auto on_circle = [](float angle, float r) {
        return Vec2(-r * std::cos(angle), r * std::sin(angle));
    };
    const auto foothold = [on_circle](int side, float angle) {
        return Foothold{on_circle(angle, radius_m - side_sign(side) * half_width_m),
                        angle + side_sign(side) * 0.08f};
    };
    std::vector<Step> steps;
    for (int i = 0; i < step_count; ++i) {
        const float lift = step_s * static_cast<float>(i) + (step_s - swing_s) / 2;
        Step step;
        step.side = i % 2 == 0 ? kLeft : kRight;
        step.lift_s = lift, step.land_s = lift + swing_s;
        // The body passes over a foothold in the middle of the other foot's swing.
        step.to = foothold(step.side, turn_rate * step_s * (static_cast<float>(i) + 1.5f));
        step.clearance_m = 0.02f, step.heel_rad = 0.5f;
        steps.push_back(step);
    }
    const StepPlan plan(foothold(kLeft, -turn_rate * step_s * 0.5f),
                        foothold(kRight, turn_rate * step_s * 0.5f), std::move(steps));
    return {[plan, on_circle](float t) {
                Figure f;
                place_feet(f, plan, t);
                const float angle = turn_rate * t, cycle = 0.5f / step_s;
                const float left_swings = wave(cycle, t);  // > 0 while the left foot is in the air
                f.heading_rad = angle;
                // Towards the carrying foot, and a pelvis that turns and drops with the swinging leg.
                f.root = on_circle(angle, radius_m + 0.02f * left_swings);
                const float stride = -std::cos(2.0f * kPi * cycle * t);  // -1 left behind, 1 left ahead
                f.pelvis = rotate_y(-5.0f * stride) * rotate_z(-3.0f * left_swings);
                f.drop_m = 0.008f;
                set_trunk(f, 3, 3.0f * left_swings, 9.0f * stride);
                for (const int side : {kLeft, kRight})
                    set_arm(f.rotation, side,
                            {10, 4 - 20 * side_sign(side) * stride, 22 - 8 * side_sign(side) * stride, 0});
                return f;
            },
            period_s};
}

}  // namespace vfit::virtual_person
