// What the motion stage shows of a stream of bodies whose truth is known, and how its feet score: contacts
// found, planted feet that move, heights of jumps, pops.
#pragma once

#include <array>
#include <vector>

#include "bench/motion_people.h"

namespace vfit::tools {

/// What motion showed in one frame.
struct Shown {
    bool valid = false;
    std::array<bool, 2> planted{};
    std::array<Vec3, 2> ankle{};
    std::array<double, 2> knee_rad{};  // flexion
    std::array<Quat, VFIT_BONE_COUNT> world;
};

/// Plays the tracked bodies of a stream through a stage of default settings.
std::vector<Shown> show_motion(const PersonStream& stream);

/// Frames of a class found within one frame, of the truth and of what was said.
struct F1 {
    size_t said = 0, said_right = 0, true_count = 0, found = 0;
    void add(const std::vector<char>& truth, const std::vector<char>& said_flags);
    void merge(const F1& other);
    double precision() const { return said ? double(said_right) / double(said) : 0.0; }
    double recall() const { return true_count ? double(found) / double(true_count) : 0.0; }
    double value() const;
};

struct FeetScore {
    F1 lifted, planted;
    // Frames of a true contact, after it has settled: all, those in which the ankle slides over the floor,
    // those in which it moves in any direction.
    size_t contact_frames = 0, skating = 0, moving = 0;
    std::vector<double> slides_m, drifts_m;  // of each contact: along the floor, and in space
    std::vector<double> pops, true_turning;  // rad/s^2
    std::vector<double> jump_heights;        // share of the truth's
    std::vector<double> knee_errors_rad;     // of legs whose foot stands

    void merge(const FeetScore& other);
    double skating_percent() const;
    double moving_percent() const;
    /// The largest angular acceleration at a switch over the 99th percentile of the true motion; no number
    /// where the truth has no rotations.
    double worst_pop() const;
};

FeetScore score_feet(const PersonStream& stream, const std::vector<Shown>& shown);

double quantile(std::vector<double> values, double q);

}  // namespace vfit::tools
