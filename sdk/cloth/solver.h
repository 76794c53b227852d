// The passes of one sub-step over the particles of a cloth.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/contact.h"
#include "cloth/fabric.h"
#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

/// Place and inverse mass in one 16-byte load.
struct alignas(16) Particle {
    Vec3 x;
    float inverse_mass;
};

/// One pass of XPBD over the constraints with the multiplier starting at zero, which is exact for one pass a
/// sub-step (Macklin et al. 2019): s = -C / (w_a + w_b + compliance / h^2).
void solve_distances(std::span<const DistanceConstraint> constraints, float h, std::span<Particle> particles);

/// Strain of each constraint.
void distance_strains(std::span<const DistanceConstraint> constraints, std::span<const Particle> particles,
                      std::span<float> strains);

void solve_tethers(std::span<const Tether> tethers, std::span<Particle> particles);

/// All contacts of a sub-step. Vertices are independent of each other: chunks of them run in parallel and give
/// the same bits for any number of workers.
struct ContactPass {
    std::span<const uint32_t> vertices;          // that can move
    std::span<const SweptCapsule> colliders;
    std::span<const Vec3> starts;                // at the begin of the sub-step, one a particle
    ContactSettings settings;

    void run(std::span<Particle> particles, Jobs& jobs) const;

private:
    void run_block(std::span<const uint32_t> block, std::span<Particle> particles) const;
};

}  // namespace vfit
