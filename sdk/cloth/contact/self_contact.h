// Contact of a cloth with itself. Each particle gets the nearest triangle before it and the nearest behind
// it, of those that are not its neighbours on the flat cloth, and stays on the side of it on which it was
// when the two met. Which runs of particles may meet is found once a step, which particles do every few
// sub-steps.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cloth/contact/surface_kernels.h"
#include "cloth/fabric/fabric.h"
#include "core/jobs.h"

namespace vfit {

class SelfContact {
public:
    SelfContact(std::shared_ptr<const Fabric> fabric, float thickness_m, Jobs* jobs = nullptr);

    /// The cloth was placed anew: which side a particle is on is seen anew as well.
    void forget();
    /// Vertices, until the next call: where two of them meet, contact does not hold them, and sees anew who
    /// is on which side.
    void let_go(std::span<const uint32_t> vertices);
    /// The begin of a step of dt; normals (unit length) stay as they are through it. Does not allocate once
    /// it has met as many contacts.
    void find_runs(const Particles& places, const Particles& velocities, const Particles& normals, float dt,
                   int substeps, Jobs& jobs);
    /// Those of a part, as particles lie now and lay at the begin of the sub-step; may run for several parts
    /// at the same time. What is slow is not looked at in each sub-step.
    void find(const Particles& places, const Particles& starts, const Particles& normals, int substep,
              uint32_t part);
    /// Once all parts have found theirs.
    void pack();
    std::span<const SurfaceContacts> contacts() const { return batches_; }

private:
    struct Contact {
        uint32_t particle;
        uint32_t corners[3];  // particles
        Vec3 weights;
        float side;
    };
    struct Seen {
        uint32_t vertex = UINT32_MAX;  // of the other layer
        float side = 0.0f;
        int16_t wrong = 0;  // sub-steps for which it has been on the other side
    };
    /// A run that may meet others, and what it has met.
    struct Watched {
        uint32_t run;
        uint32_t first, end;  // in near
        int every;            // sub-step it is looked at
        float reach_m;        // so near that the two may touch before the next look
        float corner_m;       // corner_m_ of near, at most
        uint32_t contact_count;
        Contact contacts[2 * kLanes];
    };
    /// Particles near points of other layers, for the kernel.
    struct Meetings {
        alignas(32) Particle places[kLanes];
        uint32_t points[kLanes];
        Watched* watched[kLanes];
        uint32_t particles[kLanes];
        uint8_t sides[kLanes];
        size_t count = 0;
    };
    struct Part {
        std::vector<uint32_t> meeting;  // runs that meet the one that is looked at
        std::vector<Watched> watched;
        std::vector<NearRun> near;
        bool changed = false;  // in this sub-step
    };
    float reach() const;  // between a particle and a place, within which the two are watched
    void list_neighbours();
    Vec3 facing_of(const Particles& normals, uint32_t run) const;
    void look_at(const Particles& places, const Particles& velocities, const Particles& normals,
                 const Vec3& drift, float dt, uint32_t run);
    void find_runs_of(const Particles& places, const Particles& normals, int substeps, uint32_t part);
    void meet(const Particles& places, const Particles& starts, Meetings& meetings);
    void meet(const Particles& places, const Particles& starts, const Meetings& meetings,
              const NearestOnFans& nearest, size_t lane);
    static float before_triangle(const Particles& at, uint32_t particle, uint32_t corner,
                                 const TriangleFans::Corners& others);
    float side_of(uint32_t particle, uint32_t vertex, float own) const;
    const Seen* seen_about(uint32_t particle, uint32_t vertex) const;

    std::shared_ptr<const Fabric> fabric_;
    float thickness_m_;
    std::vector<float> corner_m_;  // of each run: so much nearer may its triangles be than the corners by
                                   // which they are found
    std::vector<uint32_t> first_neighbour_;        // of each run
    std::vector<NearRun> neighbours_;              // by rising runs
    std::vector<uint32_t> first_beside_, beside_;  // of each vertex, those that share a triangle with it
    std::vector<uint8_t>
        counts_;  // of each particle: not one that fills up, nor a second copy of a fixed vertex
    std::vector<uint8_t> is_let_go_;  // of each particle
    std::vector<uint32_t> let_go_;    // those
    std::vector<uint64_t> nobody_;    // of each run, as a NearRun's: particles that do not count
    RunBoxes boxes_;                  // of the runs' particles on their way through the step, corner_m_ wider
    struct Ways {
        Vec3 least, most;
    };
    std::vector<Ways> ways_;     // of each run's particles in the step, without what all cloth shares
    std::vector<Vec3> facing_;   // of each run, unit length; zero: its triangles face several ways
    std::vector<Seen> seen_[2];  // of each particle: before it and behind it
    std::vector<Seen> seen_now_[2];
    std::vector<Part> parts_;
    std::vector<Contact> all_;
    std::vector<SurfaceContacts> batches_;
};

}  // namespace vfit
