// What one frame asks of the body: depth points near it lie on it, no part of it lies outside the outline,
// and its joints are near those that were seen.
#pragma once

#include <array>

#include "fit/fit_equations.h"
#include "fit/fit_kernels.h"
#include "fit/fit_raster.h"
#include "fit/fit_view.h"

namespace vfit {

/// A joint that the network saw. Camera space.
struct FitJoint {
    Vec3 place{0.0f};
    float confidence = 0.0f;  // 0: not seen
};
using FitJoints = std::array<FitJoint, kJointCount>;

// Standard deviations of single rows, metres, and how much of a row counts: neighbouring points err together.
// Chosen on virtual clothed people and judged on recordings (vfit-bench fit).
struct FitWeights {
    float depth_m = 0.015f, depth_share = 0.08f;
    float reach_m = 0.03f, reach_share = 0.05f;
    float outline_m = 0.015f, outline_share = 0.3f;
    float joint_m = 0.025f;
    float robust_m = 0.05f;  // residuals of this size count a quarter (Geman & McClure 1987)
    float joint_robust_m = 0.25f;
};

/// Matches depth points to visible vertices. `targets` is room to work in. Returns how many were matched.
uint32_t add_depth_rows(const FitView& view, const FitBody& body, const FitRaster& raster,
                        const FitWeights& weights, FitTargets& targets, FitEquations& equations);
/// Pulls vertices that are outside the outline to its nearest cell, and those on the model's own rim out to
/// where the person ends. `raster`: of this body and view.
uint32_t add_outline_rows(const FitView& view, const FitBody& body, const FitRaster& raster,
                          const FitWeights& weights, FitEquations& equations);
void add_joint_rows(const FitJoints& joints, const FitBody& body, const FitWeights& weights,
                    FitEquations& equations);

}  // namespace vfit
