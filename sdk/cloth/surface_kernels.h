// The hot loops of contact with surfaces, in SIMD with run-time dispatch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/particle.h"

namespace vfit {

/// The nearest point to each lane of a run, apart for what lies before its normal and behind it.
struct NearestOfRun {
    alignas(32) float distance2[2][kLanes];
    alignas(32) uint32_t id[2][kLanes];

    explicit NearestOfRun(float reach);  // none within that
};
/// Boxes, eight to a register.
struct Boxes {
    std::vector<float> low[3], high[3];  // x, y, z; filled up to whole registers with boxes that meet nothing
    void resize(size_t count);
    void set(size_t at, const Vec3& from, const Vec3& to);
    Vec3 low_of(size_t at) const { return {low[0][at], low[1][at], low[2][at]}; }
    Vec3 high_of(size_t at) const { return {high[0][at], high[1][at], high[2][at]}; }
};
/// Boxes about runs of particles, and about eight runs in a row each.
struct RunBoxes {
    Boxes runs, blocks;
    void resize(size_t count);
    void find_blocks();  // once all runs are set
};
/// The runs whose boxes meet that one, rising.
void find_meeting(const RunBoxes& boxes, const Vec3& low, const Vec3& high, std::vector<uint32_t>& runs);
/// Keeps of the runs (and excluded, as below) those of which a particle is nearer than that to one of this run; how many.
size_t keep_near(const Particle* run, const Particle* all, float reach_m, uint32_t* runs, uint64_t* excluded, size_t count);
/// Looks at the particles of these runs, which are their ids (not finite: nobody), for a run's eight particles (normals as
/// well; zero: all is before). What is nearer than out says, replaces it. excluded: of each run, a byte for
/// each of its particles, of which a bit says that it does not count for that lane; empty:
/// all count.
void find_nearest_in_runs(const Particle* run, const Particle* normals, const Particle* all, std::span<const uint32_t> runs,
                          std::span<const uint64_t> excluded, NearestOfRun& out);

/// Eight contacts of a particle with a triangle of the same cloth: it stays on one side of it, that far off.
struct alignas(32) SurfaceContacts {
    uint32_t vertex[kLanes], a[kLanes], b[kLanes], c[kLanes];  // bytes from the first particle
    float at_a[kLanes], at_b[kLanes], at_c[kLanes];            // the place on the triangle, weights
    float side[kLanes];                                        // 1: before it, -1: behind it
    float thickness_m[kLanes];
    // Of what is amiss: how far each of the four moves.
    float vertex_gain[kLanes], a_gain[kLanes], b_gain[kLanes], c_gain[kLanes];
};
/// The contacts of one item one after the other; those of the eight lanes at once, what they do to one particle added up.
void solve_surface_contacts(std::span<const SurfaceContacts> contacts, Particle* particles);

}  // namespace vfit
