// People before the camera for the tests of scans: facing it, from the side, with the arms as asked for.
#pragma once

#include "../fit/fit_scene.h"
#include "scan/person_scan.h"

namespace vfit {

struct Stance {
    float turned_rad = 0.0f;  // to the person's left
    float arms_rad = 0.6f;    // of the upper arms from the vertical
    float arms_ahead_rad = 0.0f;
};

inline FitScene standing_person(Avatar& avatar, const Stance& stance = {}) {
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    pose.rotation[VFIT_BONE_HIPS] = glm::angleAxis(stance.turned_rad, Vec3(0, 1, 0));
    const float lowered = 0.5f * kPi - stance.arms_rad;
    const Quat ahead = glm::angleAxis(-stance.arms_ahead_rad, Vec3(1, 0, 0));
    pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = ahead * glm::angleAxis(-lowered, Vec3(0, 0, 1));
    pose.rotation[VFIT_BONE_RIGHT_UPPER_ARM] = ahead * glm::angleAxis(lowered, Vec3(0, 0, 1));
    FitScene scene = shoot(avatar, pose);
    scene.joints.id = 1;
    return scene;
}

inline Stance sideways() { return {0.5f * kPi, 0.1f, 0.65f}; }

}  // namespace vfit
