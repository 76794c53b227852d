// The body's motion as it moves cloth without a step.
#pragma once

#include <span>

#include "cloth/fabric/fabric.h"
#include "cloth/solver/air.h"
#include "cloth/solver/particle_solver.h"
#include "math/types.h"

namespace vfit {

/// The body's motion since the last step. One of each per vertex.
struct CarriedAlong {
    float fraction = 1.0f;         // of the motion; the cloth feels the rest. 1: the body jumps
    std::span<const Vec3> places;  // where the vertices are after it
    std::span<const Mat3> turns;   // linear map of directions
    std::span<const Vec3> speeds;  // added to the turned velocities, m/s; may be empty
    bool rigid = false;            // all bones move as one: a sleeping cloth may stay asleep

    /// VFIT_ERROR_ARGUMENT for a wrong count.
    void check(uint32_t vertices) const;
    /// Positions, and velocities of the same magnitude.
    void move(const Fabric& fabric, ParticleSolver& solver) const;
    /// A cloth at rest stays so: neither its direction to gravity nor that to the wind changes.
    bool keeps_rest(const Vec3& gravity, const Air& air) const;
};

}  // namespace vfit
