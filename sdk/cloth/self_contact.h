// Contact of a cloth with itself. Once a step, each particle gets the nearest triangle before it and the nearest behind it, of
// those that are not its neighbours on the flat cloth, and stays on the side of it on which it was when the two met.
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
    /// For particles as they lie. Does not allocate once it has met as many contacts.
    void find(const Particles& places, Jobs& jobs);
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
        std::vector<uint32_t> near;      // runs that the one that is looked at may meet, and who of them does not count
        std::vector<uint64_t> excluded;
        std::vector<Contact> contacts;
    };
    void exclude_neighbours(float radius_m);
    void look_about(const Particles& places);
    void find_of_part(const Particles& places, uint32_t part);
    void exclude_of(uint32_t run, Part& part) const;
    void meet(const Particles& places, Part& part, uint32_t particle, uint32_t vertex, Seen& now);
    float side_seen(uint32_t particle, uint32_t vertex) const;
    void pack();

    std::shared_ptr<const Fabric> fabric_;
    TriangleFans fans_;
    float thickness_m_, reach_m_, vertex_reach_m_;
    struct Neighbour {
        uint32_t run;
        uint64_t excluded;  // as find_nearest_in_runs takes it
    };
    std::vector<uint32_t> first_neighbour_;  // of each run
    std::vector<Neighbour> neighbours_;      // by rising runs
    std::vector<Vec3> positions_;  // of the vertices
    Particles seen_places_;        // of the particles; one of a fixed vertex's copies, the others are nobody
    RunBoxes boxes_;
    Particles normals_;            // of the particles that move; not of unit length
    std::vector<Seen> seen_[2];    // of each particle: before it and behind it
    std::vector<Seen> seen_now_[2];
    std::vector<Part> parts_;
    std::vector<Contact> all_;
    std::vector<SurfaceContacts> batches_;
};

}  // namespace vfit
