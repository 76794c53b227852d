// The hot loops of a sub-step, in SIMD with run-time dispatch. Particles are four floats each, and those that
// move come in runs of kLanes (ParticleLayout).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/base/particle.h"
#include "cloth/contact/contact.h"
#include "cloth/contact/run_planes.h"
#include "cloth/fabric/distance_batches.h"
#include "cloth/fabric/hinge_batches.h"

namespace vfit {

/// The begin of the first sub-step of several. Half of the fall, then the whole way: free fall is exact.
void predict(const Moving& moving, const Vec3& half_fall, float h);

/// XPBD's share of each end: w / (w_a + w_b + compliance / h^2), with so many times the force. The greatest
/// sum of two.
float find_gains(std::span<const BatchMasses> masses, float h, float force, std::span<BatchGains> gains);
/// One pass of XPBD over the constraints with the multiplier starting at zero, which is exact for one pass a
/// sub-step (Macklin et al. 2019).
void solve_distances(std::span<const DistanceBatch> batches, std::span<const BatchGains> gains,
                     Particle* particles);

/// The same of hinges: w K / (sum of w K^2 + compliance / h^2). Batches that would take back no more than
/// `soft` of a fold, even with twice the force, are given that, to push in every second sub-step; none with
/// 0.
void find_hinge_gains(std::span<const HingeBatch> batches, std::span<const HingeMasses> masses, float h,
                      float soft, std::span<HingeGains> gains);
void solve_hinges(std::span<const HingeBatch> batches, std::span<const HingeGains> gains, bool with_soft,
                  Particle* particles);

/// What each run of kLanes moving particles may meet during a step.
struct NearColliders {
    std::vector<float> x, y, z, radii_m;  // of a ball that the run is expected to stay in
    std::vector<float> speeds2;           // the square of its highest speed
    std::vector<float> ways_m;            // that a particle of it is expected to go at most
    std::vector<uint64_t> bits;           // words() a run: bit i of them is collider i
    size_t colliders = 0;
    size_t words() const { return (colliders + 63) / 64; }
};
/// Fills x, y, z, radii_m of the balls that just hold the runs, and speeds2: as many as there are whole runs.
void find_run_balls(std::span<const Particle> moving, std::span<const Particle> velocities,
                    NearColliders& near);
/// Fills bits: which balls the colliders may touch, then which of their particles, as they lie now, on ways
/// of at most ways_m.
void find_near(std::span<const SweptCapsule> colliders, std::span<const Particle> moving,
               NearColliders& near);

/// Of a run, by lanes: balls that its particles stay out of, or in.
struct alignas(32) RunBalls {
    float x[kLanes], y[kLanes], z[kLanes];              // centres at the begin of the step
    float way_x[kLanes], way_y[kLanes], way_z[kLanes];  // to its end
    float radius_m[kLanes];                             // 0: none
    float pull_m[kLanes];                               // into it, a sub-step, at most
    uint32_t run;                                       // in Moving
};

/// The end of a sub-step, once distances are solved: tethers, limits, backstops, contacts; then velocities by
/// what constraints changed, rather than by the whole way over h, which keeps rounding of places out of the
/// speed; then the other half of the fall, and `keep` of all of it; and, where another sub-step follows, its
/// begin.
struct SubstepEnd {
    Moving moving;
    const Particle* anchors;  // of all parts; and of each lane of the runs the index of its own, and how far
    std::span<const uint32_t>
        anchor_index;  // from it it may be: long range attachment (Kim, Chentanez, Mueller 2012)
    std::span<const float> tether_m;
    std::span<const RunBalls> limits, backstops;  // to stay in and out of, by rising runs
    std::span<const RunPlanes> planes;            // by rising runs
    float from, to;                               // shares of the step
    std::span<const SweptCapsule> colliders;
    const NearColliders* may_meet;  // a run that has left its ball is tried against all
    ContactSettings contact;
    Vec3 half_fall;
    float h, keep;
    bool last;
    Particle* pushed;  // as moving: what contacts move each by is added; null: nobody asks
};
void end_substep(const SubstepEnd& end);

}  // namespace vfit
