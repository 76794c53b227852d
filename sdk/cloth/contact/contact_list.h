// Contacts that a cloth keeps open during a step: pairs of a vertex and a triangle, or of two edges, that are
// close at its begin or expected to become so.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cloth/contact/contact_kernels.h"
#include "cloth/contact/contact_pair.h"
#include "cloth/contact/flat_distances.h"
#include "cloth/contact/proximity.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

class ContactList {
public:
    /// thickness_m: kept between a vertex and a triangle; two edges keep half of it. Parts of the cloth that
    /// are closer than that where it lies flat are not held further apart.
    ContactList(std::shared_ptr<const Fabric> fabric, float thickness_m, Jobs* jobs = nullptr);

    /// Pairs further apart than that now, and after the same way again, are no contacts.
    float reach_m() const;
    /// Contacts of the step that follows one with these ends. let_go: vertices of triangles that cross; where
    /// two of them meet there is no contact. Does not allocate once it has met as many.
    void fill(const Proximity& proximity, std::span<const Particle> begin, std::span<const Particle> end,
              std::span<const uint32_t> let_go);
    void clear() { contacts_.clear(), batches_.clear(); }

    /// Contacts are looked at in that many shares.
    uint32_t share_count() const { return kShares; }
    /// Closest points and normals of a share of the contacts, as particles lie now. May run for several shares
    /// at the same time.
    void refresh(const Particles& places, uint32_t share);
    void solve(const ContactPush& push, const Particles& starts, Particles& places) const {
        solve_contacts(batches_, push, starts.data(), places.data());
    }
    size_t size() const { return contacts_.size(); }

private:
    static constexpr uint32_t kShares = 8;
    struct Contact {
        std::array<uint32_t, 4> vertices;
        PairKind kind;
        int8_t side;  // of a vertex above its triangle: 1 on the outside, -1 inside; 0: it is not above it
        std::array<float, 4> weights;
        Vec3 normal;
        float distance_m;
    };
    struct Candidates {
        std::vector<PrimitivePairs> pairs;
        size_t count = 0;

        void add(const std::array<uint32_t, 4>& vertices);
        void fill_up();
    };
    void add(PairKind kind, const Candidates& of, std::span<const Particle> end);
    void add(PairKind kind, const PrimitivePairs& pairs, size_t lane, std::span<const Particle> end);
    float flat_limit_m(PairKind kind, const std::array<uint32_t, 4>& vertices) const;
    static void look(Contact& contact, const std::array<Vec3, 4>& at);
    void pack();
    void put(const Contact& contact, size_t lane, ContactBatch& batch) const;

    std::shared_ptr<const Fabric> fabric_;
    float thickness_m_;
    FlatDistances flat_;
    std::vector<uint8_t> is_let_go_;  // of each vertex
    std::array<Candidates, 2> candidates_;  // of each kind
    std::vector<Contact> contacts_;
    std::vector<ContactBatch> batches_;
};

}  // namespace vfit
