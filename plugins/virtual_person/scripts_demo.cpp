// The demonstration: stands for the scan, then shows what cloth does: sway, swinging arms, a turn to both
// sides, steps, swinging hips, arms up.
#include "keys.h"
#include "motion.h"

namespace vfit::virtual_person {

namespace {

constexpr float kFeetApart_m = 0.25f;
constexpr float kTurn_rad = 0.698f;  // 40 degrees

// When each part begins, in seconds.
constexpr float kSway = 1.5f, kSwing = 5.0f, kTurn = 9.0f, kSteps = 14.6f, kHips = 18.6f, kArmsUp = 22.6f,
                kEnd = 26.0f;

StepPlan make_plan() {
    std::vector<Step> steps;
    const auto turn_to = [&](float begin_s, int first, float heading) {
        for (int i = 0; i < 2; ++i) {
            Step step;
            step.side = i == 0 ? first : 1 - first;
            step.lift_s = begin_s + 0.5f * static_cast<float>(i), step.land_s = step.lift_s + 0.45f;
            step.to = stand({0, 0}, heading, kFeetApart_m)[static_cast<size_t>(step.side)];
            step.heel_rad = 0.25f;
            steps.push_back(step);
        }
    };
    turn_to(kTurn + 0.3f, kLeft, kTurn_rad);
    turn_to(kTurn + 1.8f, kRight, 0);
    turn_to(kTurn + 2.8f, kRight, -kTurn_rad);
    turn_to(kTurn + 4.3f, kLeft, 0);
    for (int i = 0; i < 6; ++i) {  // marching on the spot
        Step step;
        step.side = i % 2;
        step.lift_s = kSteps + 0.2f + 0.58f * static_cast<float>(i), step.land_s = step.lift_s + 0.5f;
        step.to = stand({0, 0}, 0, kFeetApart_m)[static_cast<size_t>(step.side)];
        step.clearance_m = 0.13f, step.heel_rad = 0.4f;
        steps.push_back(step);
    }
    const auto feet = stand({0, 0}, 0, kFeetApart_m);
    return StepPlan(feet[0], feet[1], std::move(steps));
}

// Fades a part in and out within its time.
float during(float begin, float end, float t) {
    return track({{begin, 0}, {begin + 0.6f, 1}, {end - 0.6f, 1}, {end, 0}}, t);
}

}  // namespace

Script demo_script() {
    return {[plan = make_plan()](float t) {
                Figure f;
                for (const int side : {kLeft, kRight}) f.foot[static_cast<size_t>(side)] = plan.foot(side, t);
                f.heading_rad = plan.heading_rad(t);

                const float sway = during(kSway, kSwing, t) * wave(0.4f, t - kSway);
                const float swing = during(kSwing, kTurn, t) * wave(0.75f, t - kSwing);
                const float march = during(kSteps, kHips, t) * wave(0.5f / 0.58f, t - kSteps - 0.16f);
                const float hips = during(kHips, kArmsUp, t);
                const float sideways = hips * wave(0.9f, t - kHips),
                            twist = hips * wave(0.9f, t - kHips + 0.28f);
                const float up =
                    track({{kArmsUp, 0}, {kArmsUp + 1.2f, 1}, {kArmsUp + 1.6f, 1}, {kEnd - 0.5f, 0}}, t);

                const Vec2 to_left(std::cos(f.heading_rad), -std::sin(f.heading_rad));
                f.root = plan.root(t) + to_left * (0.045f * sway + 0.06f * sideways);
                f.pelvis = rotate_y(12 * twist) * rotate_z(-3 * sway - 6 * sideways);
                f.drop_m = 0.006f * (during(kSway, kSwing, t) + hips);
                set_trunk(f, 0, -3 * sway - 7 * sideways, -12 * twist + 8 * swing);

                const float scan_arms =
                    track({{0, 35}, {1.4f, 35}, {2.2f, 14}, {kEnd - 0.9f, 14}, {kEnd, 35}}, t);
                for (const int side : {kLeft, kRight}) {
                    const float s = side_sign(side);
                    set_arm(f.rotation, side,
                            {scan_arms + 8 * hips + 140 * up, 3 + s * 38 * swing - s * 22 * march,
                             8 + 10 * swing * swing + 20 * during(kSteps, kHips, t) + 22 * hips - 4 * up, 0});
                }
                return f;
            },
            kEnd};
}

}  // namespace vfit::virtual_person
