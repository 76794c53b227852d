#include "steps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vfit::virtual_person {

namespace {

constexpr float kToeOut_rad = 0.10f;   // about 6 degrees, the usual foot angle of quiet standing
constexpr float kWeightShift = 0.35f;  // of the way from mid-stance to the carrying foot
constexpr float kShiftLead_s = 0.25f;  // the weight moves before the foot lifts

Foothold mix(const Foothold& a, const Foothold& b, float s) {
    return {a.place + (b.place - a.place) * s, a.yaw_rad + (b.yaw_rad - a.yaw_rad) * s};
}

}  // namespace

float ease(float s) {
    s = std::clamp(s, 0.0f, 1.0f);
    return s * s * (3.0f - 2.0f * s);
}

float hump(float s) { return s <= 0.0f || s >= 1.0f ? 0.0f : 0.5f - 0.5f * std::cos(2.0f * kPi * s); }

namespace {

/// Over the ball, through the air, down on the heel. `hold`: from where.
void roll(const Step& step, float t, Foothold& hold, FootState& state) {
    const float off = step.lift_s + step.roll_s, on = step.land_s - step.strike_s;
    const float s = std::clamp((t - off) / (on - off), 0.0f, 1.0f);
    state.over_a_point = true, state.rolls = t < off || t > on;
    state.heel_rad = t < off  ? step.heel_rad * ease((t - step.lift_s) / step.roll_s)
                     : t < on ? step.heel_rad + (-step.strike_rad - step.heel_rad) * ease(s)
                              : -step.strike_rad * (1.0f - ease((t - on) / step.strike_s));
    state.lift_m = step.clearance_m * hump(s);
    hold = mix(hold, step.to, ease(s));
}

}  // namespace

std::array<Foothold, 2> stand(const Vec2& centre, float heading, float apart_m) {
    const Vec2 left(std::cos(heading), -std::sin(heading));
    return {Foothold{centre + left * (apart_m / 2), heading + kToeOut_rad},
            Foothold{centre - left * (apart_m / 2), heading - kToeOut_rad}};
}

StepPlan::StepPlan(const Foothold& left, const Foothold& right, std::vector<Step> steps)
    : start_{left, right}, steps_(std::move(steps)) {}

FootState StepPlan::foot(int side, float t) const {
    Foothold hold = start_[static_cast<size_t>(side)];
    FootState state;
    for (const Step& step : steps_) {
        if (step.side != side || t <= step.lift_s) continue;
        if (t >= step.land_s) {
            hold = step.to;
            continue;
        }
        state.planted = false;
        if (step.roll_s > 0.0f) {
            roll(step, t, hold, state);
            break;
        }
        const float s = (t - step.lift_s) / (step.land_s - step.lift_s);
        hold = mix(hold, step.to, ease((s - 0.15f) / 0.85f));  // the heel comes up before the foot moves on
        state.heel_rad = step.heel_rad * hump(s / 0.75f);
        state.lift_m = step.clearance_m * hump(s);
        break;
    }
    state.place = hold.place;
    state.yaw_rad = hold.yaw_rad;
    return state;
}

Vec2 StepPlan::root(float t) const {
    const Vec2 left = foot(kLeft, t).place, right = foot(kRight, t).place;
    const Vec2 middle = (left + right) * 0.5f;
    Vec2 root = middle;
    for (const Step& step : steps_) {
        const float begin = step.lift_s - kShiftLead_s, end = step.land_s + kShiftLead_s;
        const Vec2 carrier = step.side == kLeft ? right : left;
        root += (carrier - middle) * (kWeightShift * hump((t - begin) / (end - begin)));
    }
    return root;
}

float StepPlan::heading_rad(float t) const {
    return (foot(kLeft, t).yaw_rad + foot(kRight, t).yaw_rad) * 0.5f;
}

}  // namespace vfit::virtual_person
