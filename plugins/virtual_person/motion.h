// How the person moves: a pose for each instant, with the feet exactly on the floor.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "figure.h"

namespace vfit::virtual_person {

class Motion {
public:
    virtual ~Motion() = default;
    /// t from 0 on, in seconds; goes on without end.
    virtual BonePose at(double t) const = 0;
};

/// A scripted motion: a figure for each instant of one round, which is then repeated.
struct Script {
    std::function<Figure(float)> figure;
    float period_s = 1.0f;
};

inline constexpr float kScanArms_deg = 35.0f, kSideArms_deg = 37.0f, kRoundArms_deg = 42.0f;
Script scan_script(float arms_deg = kScanArms_deg);
Script side_script(float arms_deg = kSideArms_deg);
Script sway_script();
Script turn_script();
Script walk_script();
Script wave_script();
Script reach_script();
Script squat_script();
Script demo_script();
Script cross_script();
Script clap_script();
Script forward_script();
Script sit_script();
Script spin_script();
Script round_script(float arms_deg = kRoundArms_deg);
Script jog_script();
Script visit_script();
Script jump_script();
Script step_script();
Script balance_script();
Script stride_script(uint64_t seed);
Script shuffle_script(uint64_t seed);

/// "scan, sway, turn, ...", for messages.
std::string motion_names();
bool is_motion(const std::string& name);
/// A scripted motion, with the small sway and breath of a standing person, which the seed shifts in time.
/// `arms_deg`: option "arms".
std::unique_ptr<Motion> make_scripted_motion(const std::string& name, const Proportions& proportions,
                                             uint64_t seed, float arms_deg = -1.0f);
/// The motion of a BVH file carried over to those proportions.
std::unique_ptr<Motion> make_bvh_motion(const std::string& path, const Proportions& proportions);

}  // namespace vfit::virtual_person
