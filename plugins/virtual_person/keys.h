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

}  // namespace vfit::virtual_person
