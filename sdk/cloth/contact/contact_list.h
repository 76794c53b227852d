// Contacts that a cloth keeps open during a step: pairs of a vertex and a triangle, or of two edges, that are
// close at its begin or expected to become so.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cloth/contact/contact_kernels.h"
#include "cloth/contact/contact_pair.h"
#include "cloth/contact/flat_distances.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/contact/proximity.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

/// Kept between a vertex and a triangle of the cloth; two edges keep half of it.
struct LayerThickness {
    std::vector<float> own_m;  // within each piece of the fabric; 0: it passes through itself
    float between_m = 0.0f;    // pieces; 0: these pass through each other

    /// Triangles further apart than that now, and after the same way again, have no contact; 0: none has.
    float reach_m() const;
};

class ContactList {
public:
    /// Parts of the cloth that are closer than its thickness where it lies flat are not held further apart.
    ContactList(std::shared_ptr<const Fabric> fabric, const LayerThickness& thickness, Jobs* jobs = nullptr);
    /// A solid, whose vertices follow. keeps_m: between these and the cloth's triangles, and between edges.
    void add_mesh(size_t vertices, float keeps_m, MeshOf what);

    /// Pairs further apart than that now, and after the same way again, are no contacts.
    static float reach_m(float keeps_m);
    /// Contacts of the step that follows one with these ends. tangled: flags of vertices whose triangles
    /// cross, or empty; where two of them meet there is no contact, or of two pieces one that moves the later
    /// one outwards. Does not allocate once it has met as many.
    void fill(const Proximity& proximity, std::span<const Particle> begin, std::span<const Particle> end,
              std::span<const uint8_t> tangled);

    /// Particles beyond the fabric's that stand for vertices of meshes.
    size_t mesh_particle_count() const { return mesh_vertices_.size(); }
    /// Places them for a sub-step, as shares of the step with these ends.
    void place_meshes(std::span<const Particle> begin, std::span<const Particle> end, float from, float to,
                      Particles& starts, Particles& places) const;

    /// Contacts are refreshed in that many parts.
    uint32_t share_count() const { return kShares; }
    /// Closest points and normals of one of these parts, as particles lie now. May run for several
    /// parts at the same time.
    void refresh(const Particles& places, uint32_t share);
    void solve(const ContactPush& push, const Particles& starts, Particles& places) const;
    size_t size() const { return of_kind_[0].contacts.size() + of_kind_[1].contacts.size(); }

private:
    static constexpr uint32_t kShares = 8;
    struct Contact {
        std::array<uint32_t, 4> vertices;
        Vec3 normal;
        float distance_m, side;
    };
    struct OfKind {
        std::vector<Contact> contacts;
        std::vector<ContactBatch> batches;
    };
    /// Which way the first of two primitives lies outside of the second.
    struct Side {
        Vec3 way{0.0f};  // unit length; 0: there is no outside
        uint32_t surface = 0;
    };
    struct Candidates {
        std::vector<PrimitivePairs> pairs;
        std::vector<Side> sides;
        size_t count = 0;

        void add(const std::array<uint32_t, 4>& vertices, const Side& side);
        void fill_up();
    };
    void add(PairKind kind, const Candidates& of, std::span<const Particle> end);
    void add(PairKind kind, const PrimitivePairs& pairs, size_t lane, const Side& side,
             std::span<const Particle> end);
    void add_candidates(const Proximity::Pair& pair, uint32_t surface, std::span<const Particle> end);
    bool reaches(float distance_m, float kept_m, const std::array<uint32_t, 4>& vertices,
                 uint32_t surface) const;
    float keeps_m(PairKind kind, const std::array<uint32_t, 4>& vertices, uint32_t surface) const;
    uint32_t particle_of(uint32_t vertex);
    float flat_limit_m(PairKind kind, const std::array<uint32_t, 4>& vertices) const;
    void pack(OfKind& of);

    std::shared_ptr<const Fabric> fabric_;
    LayerThickness thickness_;
    std::vector<uint8_t> piece_of_;  // of each vertex of the cloth
    struct Surface {
        float keeps_m;
        MeshOf what;
    };
    std::vector<Surface> meshes_;
    bool is_solid(uint32_t surface) const {
        return surface != Proximity::kSelf && meshes_[surface - 1].what == MeshOf::solid;
    }
    std::vector<float> inverse_mass_;  // of each vertex, meshes included
    FlatDistances flat_;
    std::span<const uint8_t> tangled_;      // while it is filled
    std::array<Candidates, 2> candidates_;  // of each kind
    std::vector<uint32_t> slots_;           // of a mesh's vertex: its particle, if its round is this one
    std::vector<uint32_t> slot_rounds_;
    uint32_t round_ = 0;
    std::vector<uint32_t> mesh_vertices_;  // of the particles beyond the fabric's
    std::array<OfKind, 2> of_kind_;
};

}  // namespace vfit
