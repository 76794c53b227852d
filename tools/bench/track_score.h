// How far tracked joints lie from reference joints: shares, medians, offsets between two definitions of a
// joint.
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
/// Whether shoulders, arms and legs lie nearer to the reference with left and right exchanged.
bool sides_are_exchanged(const Joints& tracked, const Joints& reference);
/// How far the hips are turned away from a camera that looks at them, 0 (faces it) to pi; not a number where
/// a hip is missing.
double turned_away_rad(const Joints& joints);

/// A frame of a recording: what was tracked and what the reference says.
struct Pair {
    Joints tracked, reference;
    bool usable = true;                      // the reference's bones have their usual lengths
    std::array<bool, kScored> on_body{};     // the reference joint lies on the silhouette
    std::array<bool, kScored> on_surface{};  // and, an arm's, near the depth that was measured there
};

/// A constant place of each joint in the body's own axes that carries tracked joints to the reference's
/// definition.
class Offsets {
public:
    /// Component-wise medians over the pairs.
    static Offsets fit(const std::vector<Pair>& pairs);
    Joints apply(const Joints& tracked) const;
    /// Metres to the person's left, up and ahead.
    const std::array<double, 3>& of(int joint) const { return by_joint_[size_t(joint)]; }

private:
    std::array<std::array<double, 3>, kScored> by_joint_{};
};

/// Errors by joint, in metres.
class Errors {
public:
    void add(int joint, double metres) { values_[size_t(joint)].push_back(metres); }
    /// A joint that was not found: it is not within any distance, and has none to add to mean and median.
    void add_missing(int joint) { ++missing_[size_t(joint)]; }
    /// Every joint of the reference; null: nothing was found.
    void add_all(const Joints* tracked, const Joints& reference);
    void merge(const Errors& other);
    size_t count() const;
    size_t count_of(int joint) const { return values_[size_t(joint)].size(); }
    size_t missing(int joint = -1) const;
    double median(int joint = -1) const;  // -1: of all
    double mean(int joint = -1) const;
    /// Share of all that were to be found.
    double within(double metres, int joint = -1) const;
    /// {"median_m", "mean_m", "within_10cm", "n", "missing", "joints": {"HEAD": {...}, ...}}
    Json json() const;

private:
    std::vector<double> values(int joint) const;
    std::array<std::vector<double>, kScored> values_;
    std::array<size_t, kScored> missing_{};
};

}  // namespace vfit::tools
