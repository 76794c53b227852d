// A value over time given by a few keys, at rest in each of them.
#pragma once

#include <cmath>
#include <initializer_list>

#include "steps.h"

namespace vfit::virtual_person {

struct Key {
    float t_s, value;
};

inline float track(std::initializer_list<Key> keys, float t) {
    const Key* before = keys.begin();
    for (const Key& key : keys) {
        if (t < key.t_s)
            return before->value +
                   (key.value - before->value) * ease((t - before->t_s) / (key.t_s - before->t_s));
        before = &key;
    }
    return before->value;
}

/// sin(2 pi cycles t)
inline float wave(float cycles_per_s, float t) { return std::sin(2.0f * kPi * cycles_per_s * t); }

/// The trunk bent forwards, to the person's left and turned to it, shared by its three bones.
inline void set_trunk(Figure& figure, float forward_deg, float left_deg, float turn_deg) {
    const Quat third = rotate_y(turn_deg / 3) * rotate_x(forward_deg / 3) * rotate_z(-left_deg / 3);
    for (const int bone : {VFIT_BONE_SPINE, VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST})
        figure.rotation[static_cast<size_t>(bone)] = third;
}

inline constexpr ArmAngles kHanging{12, 3, 14, 0};

/// Upright, feet 0.25 m apart, arms hanging.
inline Figure standing() {
    constexpr float apart_m = 0.25f;
    Figure f;
    const auto feet = stand({0, 0}, 0, apart_m);
    for (size_t i = 0; i < 2; ++i) f.foot[i].place = feet[i].place, f.foot[i].yaw_rad = feet[i].yaw_rad;
    for (const int side : {kLeft, kRight}) set_arm(f.rotation, side, kHanging);
    return f;
}

/// `a` at s = 0, `b` at s = 1.
inline ArmAngles mix(const ArmAngles& a, const ArmAngles& b, float s) {
    return {a.abduct + (b.abduct - a.abduct) * s, a.flex + (b.flex - a.flex) * s,
            a.elbow + (b.elbow - a.elbow) * s, a.turn + (b.turn - a.turn) * s};
}

/// The feet of a plan at that time.
inline void place_feet(Figure& figure, const StepPlan& plan, float t) {
    for (const int side : {kLeft, kRight}) figure.foot[static_cast<size_t>(side)] = plan.foot(side, t);
}

}  // namespace vfit::virtual_person
