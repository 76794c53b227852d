// How far tracked joints lie from reference joints: shares, medians, offsets between two definitions of a joint.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

inline constexpr int kScored = 15;  // the paper's joints

/// Camera space, metres; not a number where a joint is missing.
struct Joints {
    std::array<std::array<double, 3>, kScored> at;
    Joints() {
        for (auto& p : at) p.fill(std::numeric_limits<double>::quiet_NaN());
    }
    bool has(int j) const { return at[size_t(j)][0] == at[size_t(j)][0]; }
};

Joints joints_in_camera(vfit_frame frame, uint32_t body_id, const vfit_camera& camera);
double distance(const Joints& a, const Joints& b, int joint);
Joints with_sides_exchanged(const Joints& joints);

/// A frame of a recording: what was tracked and what the reference says.
struct Pair {
    Joints tracked, reference;
    bool usable = true;                      // the reference's bones have their usual lengths
    std::array<bool, kScored> on_body{};     // the reference joint lies on the silhouette
};

/// A constant place of each joint in the body's own axes that carries tracked joints to the reference's definition.
class Offsets {
public:
    /// Component-wise medians over the pairs.
    static Offsets fit(const std::vector<Pair>& pairs);
    Joints apply(const Joints& tracked) const;

private:
    std::array<std::array<double, 3>, kScored> by_joint_{};
};

/// Errors by joint, in metres.
class Errors {
public:
    void add(int joint, double metres) { values_[size_t(joint)].push_back(metres); }
    size_t count() const;
    double median(int joint = -1) const;  // -1: of all
    double mean(int joint = -1) const;
    double within(double metres, int joint = -1) const;
    /// {"median_m", "mean_m", "within_10cm", "n", "joints": {"HEAD": {...}, ...}}
    Json json() const;

private:
    std::vector<double> values(int joint) const;
    std::array<std::vector<double>, kScored> values_;
};

}  // namespace vfit::tools
