// Scripted motions on feet that roll, drawn by the seed. stride: a circle at an everyday pace; the heel rises
// over the ball while the other foot comes down on its heel (stance and swing by Perry 1992, Gait Analysis,
// chapters 1 and 4). shuffle: steps, slides along the floor and raised heels, quick and slow, in any
// direction.
#include <algorithm>
#include <cmath>

#include "keys.h"
#include "motion.h"
#include "random.h"

namespace vfit::virtual_person {

Script stride_script(uint64_t seed) {
    const uint64_t bits = random_bits(0x73747269, seed);
    uint64_t drawn = 0;
    const auto draw = [&](float low, float high) { return low + (high - low) * uniform(bits, drawn++); };
    const float step_s = draw(0.46f, 0.75f), radius_m = draw(0.45f, 0.85f), half_width_m = draw(0.05f, 0.1f);
    const float swing_s = step_s * draw(0.66f, 0.80f), push_s = step_s * draw(0.25f, 0.55f),
                strike_s = step_s * draw(0.10f, 0.24f);
    const float push_rad = draw(0.35f, 0.8f), strike_rad = draw(0.1f, 0.4f), clearance_m = draw(0.01f, 0.04f);
    const float way = draw(0, 1) < 0.5f ? -1.0f : 1.0f;  // 1: to the left
    const float stride_m = draw(0.3f, 0.65f);            // of one step
    const int pairs = std::max(3, int(std::lround(kPi * radius_m / stride_m)));
    const float period_s = 2.0f * float(pairs) * step_s, turn_rate = way * 2.0f * kPi / period_s;
    // The centre lies on the person's left where they turn to the left; the heading is the angle.
    const auto on_circle = [way](float angle, float r) {
        return Vec2(-way * r * std::cos(angle), way * r * std::sin(angle));
    };
    const auto foothold = [=](int side, float angle) {
        return Foothold{on_circle(angle, radius_m - way * side_sign(side) * half_width_m),
                        angle + side_sign(side) * 0.1f};
    };
    std::vector<Step> steps;
    // A foot leaves the floor before the round begins and comes down after its end.
    for (int i = -4; i < 2 * pairs + 4; ++i) {
        const float middle = step_s * (float(i) + 0.5f);  // of the swing
        Step step;
        step.side = i % 2 == 0 ? kLeft : kRight;
        step.lift_s = middle - 0.5f * swing_s - push_s, step.land_s = middle + 0.5f * swing_s + strike_s;
        step.to = foothold(step.side, turn_rate * step_s * (float(i) + 1.5f));
        step.clearance_m = clearance_m, step.heel_rad = push_rad;
        step.roll_s = push_s, step.strike_s = strike_s, step.strike_rad = strike_rad;
        steps.push_back(step);
    }
    const StepPlan plan(foothold(kLeft, -turn_rate * step_s * 4.5f),
                        foothold(kRight, -turn_rate * step_s * 3.5f), std::move(steps));
    return {[=](float t) {
                Figure f;
                place_feet(f, plan, t);
                const float angle = turn_rate * t, cycle = 0.5f / step_s;
                const float left_swings = wave(cycle, t);
                f.heading_rad = angle;
                f.root = on_circle(angle, radius_m + way * 0.02f * left_swings);
                const float stride = -std::cos(2.0f * kPi * cycle * t);  // -1 left behind, 1 left ahead
                f.pelvis = rotate_y(-6.0f * stride) * rotate_z(-3.0f * left_swings);
                f.drop_m = 0.012f;
                set_trunk(f, 3, 3.0f * left_swings, 10.0f * stride);
                for (const int side : {kLeft, kRight})
                    set_arm(f.rotation, side,
                            {10, 4 - 24 * side_sign(side) * stride, 22 - 8 * side_sign(side) * stride, 0});
                return f;
            },
            period_s};
}

namespace {

class Shuffle {
public:
    explicit Shuffle(uint64_t seed) : bits_(random_bits(0x73687566, seed)) {
        for (int i = 0; i < kSteps; ++i) {
            const int side = chance(0.8f) ? 1 - last_side_ : last_side_;
            const bool stays = chance(0.1f);
            add(side, stays ? hold_[size_t(side)] : somewhere(side));
        }
        for (const int side : {kLeft, kRight}) add(side, home_[size_t(side)]);
    }
    StepPlan plan() const { return {home_[0], home_[1], steps_}; }
    float period_s() const { return landed_s_ + 0.5f; }

private:
    static constexpr int kSteps = 20;

    float draw(float low, float high) { return low + (high - low) * uniform(bits_, drawn_++); }
    bool chance(float p) { return draw(0, 1) < p; }
    Foothold somewhere(int side) {
        return {{side_sign(side) * draw(0.03f, 0.4f), draw(-0.3f, 0.3f)}, draw(-0.6f, 0.6f)};
    }
    void add(int side, const Foothold& to) {
        Step step;
        step.side = side, step.to = to;
        step.roll_s = chance(0.25f) ? draw(0.4f, 1.5f) : draw(0.08f, 0.3f);
        step.strike_s = draw(0.05f, 0.25f);
        const float swing_s = chance(0.3f) ? draw(0.6f, 1.6f) : draw(0.25f, 0.6f);
        step.heel_rad = draw(0.05f, 0.8f), step.strike_rad = draw(0.0f, 0.4f);
        step.clearance_m = chance(0.35f) ? draw(0.0f, 0.004f) : draw(0.01f, 0.1f);
        // The heel may rise while the other foot comes down, but the ball leaves the floor after it.
        const float wait_s = chance(0.5f) ? draw(0.0f, 0.7f) : 0.0f;
        step.lift_s = side == last_side_ ? landed_s_ + 0.05f + wait_s
                                         : std::max(landed_s_ - draw(0.0f, 0.9f) * step.roll_s + wait_s,
                                                    hold_since_s_[size_t(side)] + 0.05f);
        step.land_s = step.lift_s + step.roll_s + swing_s + step.strike_s;
        landed_s_ = hold_since_s_[size_t(side)] = step.land_s;
        hold_[size_t(side)] = to;
        last_side_ = side;
        steps_.push_back(step);
    }

    const uint64_t bits_;
    uint64_t drawn_ = 0;
    std::array<Foothold, 2> home_ = stand({0, 0}, 0, 0.24f), hold_ = home_;
    std::array<float, 2> hold_since_s_{0.3f, 0.3f};
    float landed_s_ = 0.5f;
    int last_side_ = kLeft;
    std::vector<Step> steps_;
};

}  // namespace

Script shuffle_script(uint64_t seed) {
    const Shuffle shuffle(seed);
    return {[plan = shuffle.plan()](float t) {
                Figure f;
                place_feet(f, plan, t);
                f.root = plan.root(t);
                f.heading_rad = plan.heading_rad(t);
                f.drop_m = 0.02f;
                for (const int side : {kLeft, kRight}) set_arm(f.rotation, side, {14, 4, 18, 0});
                return f;
            },
            shuffle.period_s()};
}

}  // namespace vfit::virtual_person
