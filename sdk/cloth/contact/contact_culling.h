// Which colliders each run of particles may meet during a step: looked up once for all its sub-steps.
#pragma once

#include <span>

#include "cloth/solver/cloth_kernels.h"

namespace vfit {

/// A particle may go further than its speed says, as constraints pull it along.
inline float expected_way_m(float way_m) { return 1.25f * way_m + 0.002f; }

/// For so many particles and colliders at most, cull() does not allocate.
void reserve(NearColliders& near, size_t moving, size_t colliders);

/// For `moving` particles (whole runs) that have those velocities now, and colliders on their way through a
/// step of `dt`.
void cull(std::span<const Particle> moving, std::span<const Particle> velocities, float dt,
          std::span<const SweptCapsule> colliders, NearColliders& near);

}  // namespace vfit
