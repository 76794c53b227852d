// The trunk of a tracked person, from whichever of its joints a source has: 15 joints, 20, or only an
// upper body.
#pragma once

#include "frame/body.h"

namespace vfit {

struct Trunk {
    Vec3 hip_middle{0.0f};   // midpoint of the hip joints
    Vec3 neck{0.0f};         // base of the neck
    Vec3 hip_left{0.0f};     // unit vector to the person's left along the hip joints
    Vec3 chest_left{0.0f};   // the same along the shoulders
    bool hips_seen = false;  // both hip joints; else hip_middle is derived

    Vec3 up() const { return glm::normalize(neck - hip_middle); }
};

/// False where there is too little to place a trunk: neither both shoulders nor a neck with a pelvis.
bool find_trunk(const Body& body, Trunk& out);

}  // namespace vfit
