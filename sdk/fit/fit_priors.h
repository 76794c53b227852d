// What is known of a pose before it is seen: how far people turn their joints, and that they do not jump.
#pragma once

#include "fit/fit_equations.h"

namespace vfit {

/// Usual turns of every bone with their spread, and walls at the natural ranges (body/range_of_motion.h).
void add_pose_priors(const FitState& state, FitEquations& equations);

/// The pose is near that of `last`, `frames` (of 1/30 s) before.
void add_motion_priors(const FitState& state, const FitState& last, float frames, FitEquations& equations);

/// The derivative of the turn vector v = log(q) by a small turn that is applied before q (the inverse right
/// Jacobian of SO(3), Chirikjian 2012).
Mat3 turn_derivative(const Vec3& v);

}  // namespace vfit
