// The hot loops of a sub-step, in SIMD with run-time dispatch. Particles are four floats each, and those that move come in
// runs of kLanes (ParticleLayout).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/contact.h"
#include "cloth/distance_batches.h"
#include "cloth/particle.h"

namespace vfit {

/// Of the particles that move.
struct Moving {
    Particle* places;
    Particle* starts;      // at the begin of the sub-step
    Particle* predicted;   // where it would end without constraints
    Particle* velocities;
    uint32_t count;        // a multiple of kLanes
};

/// Half of the fall, then the whole way: free fall is exact.
void predict(const Moving& moving, const Vec3& half_fall, float h);
/// What the constraints changed, rather than the whole way over h: rounding of places stays out of the speed. Then the other
/// half of the fall, and `keep` of all of it.
void find_velocities(const Moving& moving, const Vec3& half_fall, float h, float keep);
/// The end of one sub-step and the begin of the next in one pass.
void find_velocities_and_predict(const Moving& moving, const Vec3& half_fall, float h, float keep);

/// XPBD's share of each end: w / (w_a + w_b + compliance / h^2).
void find_gains(std::span<const BatchMasses> masses, float h, std::span<BatchGains> gains);
/// One pass of XPBD over the constraints with the multiplier starting at zero, which is exact for one pass a sub-step
/// (Macklin et al. 2019).
void solve_distances(std::span<const DistanceBatch> batches, std::span<const BatchGains> gains, Particle* particles);

/// |x - anchor| <= length_m of each moving particle: long range attachment (Kim, Chentanez, Mueller 2012).
void solve_tethers(std::span<const uint32_t> anchors, std::span<const float> lengths_m, Particle* particles);

/// What each run of kLanes moving particles may meet during a step.
struct NearColliders {
    Particles centers;            // of a ball that the run is expected to stay in
    std::vector<float> radii_m;
    std::vector<float> speeds2;   // the square of its highest speed
    std::vector<uint64_t> bits;   // words() a run: bit i of them is collider i
    size_t colliders = 0;
    size_t words() const { return (colliders + 63) / 64; }
};
/// Fills centers, radii_m of the balls that just hold the runs, and speeds2: as many as there are whole runs.
void find_run_balls(std::span<const Particle> moving, std::span<const Particle> velocities, NearColliders& near);
/// Fills bits from centers and radii_m.
void find_near(std::span<const SweptCapsule> colliders, NearColliders& near);

struct ContactJob {
    Particle* places;
    const Particle* starts;
    std::span<const SweptCapsule> colliders;
    ContactSettings settings;
    const NearColliders* near;  // a run that has left its ball is tried against all
};
void resolve_contacts(const ContactJob& job, uint32_t first_run, uint32_t last_run);

}  // namespace vfit
