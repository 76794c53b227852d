// A plan of footsteps: where each foot stands from when to when. Between landing and lifting the whole sole
// stands and does not move at all; that is the ground truth of the contacts.
#pragma once

#include <array>
#include <vector>

#include "figure.h"

namespace vfit::virtual_person {

struct Foothold {
    Vec2 place{0, 0};
    float yaw_rad = 0;
};

struct Step {
    int side = kLeft;
    float lift_s = 0, land_s = 0;
    Foothold to;
    float clearance_m = 0.03f;  // of the sole in mid swing
    float heel_rad = 0.35f;     // how far the heel comes up first
    // A foot that rolls: after lift_s on its ball, before land_s on its heel with the toes up; 0: it does
    // not.
    float roll_s = 0, strike_s = 0, strike_rad = 0;
};

class StepPlan {
public:
    StepPlan() = default;
    /// Steps of one foot must follow each other in time.
    StepPlan(const Foothold& left, const Foothold& right, std::vector<Step> steps);

    FootState foot(int side, float t) const;
    /// The point between the feet, moved towards the foot that carries the body while the other one swings.
    Vec2 root(float t) const;
    /// Mean direction of the feet.
    float heading_rad(float t) const;

private:
    std::array<Foothold, 2> start_;
    std::vector<Step> steps_;
};

/// Feet apart_m apart about `centre`, toes turned out a little.
std::array<Foothold, 2> stand(const Vec2& centre, float heading_rad, float apart_m);

/// 3 s^2 - 2 s^3 with s clamped to 0..1.
float ease(float s);
/// (1 - cos)/2 over 0..1, 0 outside: up and down again without a jolt.
float hump(float s);

}  // namespace vfit::virtual_person
