// Contact of a cloth with itself. Each particle gets the nearest triangle before it and the nearest behind it, of those that
// are not its neighbours on the flat cloth, and stays on the side of it on which it was when the two met. Which runs of
// particles may meet is found once a step, which particles do every few sub-steps.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cloth/fabric.h"
#include "cloth/surface_kernels.h"
#include "cloth/triangle_fans.h"
#include "core/jobs.h"

namespace vfit {

class SelfContact {
public:
    SelfContact(std::shared_ptr<const Fabric> fabric, float thickness_m);

    /// The cloth was placed anew: which side a particle is on is seen anew as well.
    void forget();
    /// The begin of a step of dt. Does not allocate once it has met as many contacts.
    void find_runs(const Particles& places, const Particles& velocities, float dt, Jobs& jobs);
    /// Those of a part, as particles lie now; may run for several parts at the same time.
    void find(const Particles& places, uint32_t part);
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
    };
    struct Part {
        std::vector<uint32_t> meeting;   // runs that meet the one that is looked at
        std::vector<uint32_t> runs;      // those that may meet others,
        std::vector<uint32_t> first;     // and for each of them, from here on,
        std::vector<uint32_t> near;      // whom, and who of those does not count
        std::vector<uint64_t> excluded;
        std::vector<Contact> contacts;
    };
    void exclude_neighbours(float radius_m);
    void list_neighbours();
    Vec3 facing_of(const Particles& places, uint32_t run) const;
    void look_at(const Particles& places, const Particles& velocities, const Vec3& drift, float dt, uint32_t run);
    void find_normals(const Particles& places, uint32_t run);
    void find_runs_of(const Particles& places, uint32_t part);
    void meet(const Particles& places, Part& part, uint32_t particle, uint32_t vertex, Seen& now);
    float side_of(uint32_t particle, uint32_t vertex, float now) const;
    float side_seen(uint32_t particle, uint32_t vertex) const;

    std::shared_ptr<const Fabric> fabric_;
    TriangleFans fans_;
    float thickness_m_, reach_m_, vertex_reach_m_;
    struct Neighbour {
        uint32_t run;
        uint64_t excluded;  // as find_nearest_in_runs takes it
    };
    std::vector<uint32_t> first_neighbour_;  // of each run
    std::vector<Neighbour> neighbours_;      // by rising runs
    std::vector<uint32_t> first_beside_, beside_;  // of each vertex, those that share a triangle with it
    std::vector<uint8_t> counts_;  // of each particle: not one that fills up, nor a second copy of a fixed vertex
    Boxes boxes_;          // of the runs' particles on their way through the step,
    RunBoxes wide_boxes_;  // and of the triangles about them
    std::vector<float> ways_m_;    // of the runs in the step, at most
    std::vector<Vec3> facing_;     // of each run, unit length; zero: its triangles face several ways
    Particles normals_;            // of the particles that move; not of unit length
    std::vector<Seen> seen_[2];    // of each particle: before it and behind it
    std::vector<Seen> seen_now_[2];
    std::vector<Part> parts_;
    std::vector<Contact> all_;
    std::vector<SurfaceContacts> batches_;
};

}  // namespace vfit
