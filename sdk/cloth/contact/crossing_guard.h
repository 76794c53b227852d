// Keeps a cloth from crossing itself and meshes: the ways of all vertices through a step are certified by
// continuous collision detection, and changed where two triangles would touch. First single contacts are
// projected; what that does not solve moves as one, in rigid impact zones (Provot 1997; Bridson, Fedkiw,
// Anderson 2002).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cloth/contact/contact_pair.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/contact/proximity.h"
#include "cloth/contact/triangle_groups.h"
#include "cloth/contact/untangle.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

class CrossingGuard {
public:
    /// Vertices without a finite mass do not give way.
    explicit CrossingGuard(const FabricData& fabric);
    /// Vertices of a mesh follow, which do not give way either. Crossings with guarded
    /// meshes are repaired by projections alone; other meshes are left to contact.
    void add_mesh(size_t vertices, MeshOf what);

    /// Changes `end` so that no triangles cross on linear ways from `begin`, except those that crossed at
    /// `begin` already: those of the cloth are moved apart a little, those of a mesh are left to contact.
    /// True: nothing crosses at the end, which is proven.
    bool keep(std::span<const Particle> begin, std::span<Particle> end, Proximity& proximity, Jobs& jobs);
    /// Moves triangles that cross apart, at rest.
    void part(std::span<Particle> places, Proximity& proximity, Jobs& jobs);

    /// Vertices that the last call moved, and whether as part of a zone: then their velocity is its.
    std::span<const uint32_t> moved() const { return moved_; }
    bool is_in_zone(uint32_t vertex) const { return parent_[vertex] != kNone; }
    /// In the last call, a triangle of the cloth crossed one of that guarded mesh at both ends.
    bool crosses_mesh(uint32_t mesh) const { return crosses_[mesh + 1] != 0; }
    /// Vertices of triangles that crossed at the begin, and still do.
    std::span<const uint32_t> tangled() const { return tangled_; }

private:
    static constexpr uint32_t kNone = UINT32_MAX;
    struct Hit {
        std::array<uint32_t, 4> vertices;
        std::array<float, 4> weights;  // of the closest points where the two touch
        Vec3 normal;                   // between the two at the begin
        float margin_m;                // that they are to keep along it
    };
    void find_hits(std::span<const Particle> begin, std::span<const Particle> end, const Proximity& proximity,
                   bool of_meshes);
    void test(PairKind kind, const std::array<uint32_t, 4>& vertices, std::span<const Particle> begin,
              std::span<const Particle> end);
    bool is_held(const Proximity::Triangle& t) const;
    bool in_one_zone(std::span<const uint32_t> vertices);
    void project(std::span<Particle> end);
    void unite(uint32_t a, uint32_t b);
    uint32_t root(uint32_t vertex);
    void unite_hits();
    void move_zones(std::span<const Particle> begin, std::span<Particle> end);
    void move_zone(std::span<const uint32_t> zone, std::span<const Particle> begin, std::span<Particle> end);
    void take_back(std::span<const Particle> begin, std::span<Particle> end);
    void find_pairs_again(std::span<const Particle> begin, std::span<const Particle> end,
                          Proximity& proximity);
    void keep_tangles_of(std::span<const Particle> end);
    void mark(uint32_t vertex);
    void untangle(std::span<Particle> places, float step_m);

    uint32_t cloth_vertices_;
    std::vector<float> inverse_mass_;
    std::vector<uint32_t> indices_;
    std::vector<Hit> hits_;
    std::vector<std::pair<const Proximity::Triangle*, const Proximity::Triangle*>>
        crossed_;                                  // at the end alone
    std::vector<TrianglePair> tangles_;            // of the cloth at both ends, by their numbers
    bool crosses_mesh_ = false;                    // at both ends, or it was not kept from it
    std::vector<MeshOf> surfaces_{MeshOf::cloth};  // the cloth's own first
    std::vector<uint8_t> crosses_{0};              // one a surface: at both ends
    std::vector<uint8_t> is_marked_, is_moved_;    // in this round, in all
    std::vector<uint8_t> is_beyond_;               // of what found_at_ allows for
    std::vector<uint32_t> moved_;
    std::vector<Particle> wanted_;          // the end that the step made
    std::vector<Vec3> found_at_;            // where the pairs were found
    std::vector<uint32_t> parent_, zoned_;  // of each vertex in a zone; those, zone by zone
    std::vector<uint32_t> numbers_;
    std::vector<Vec3> from_, to_;  // of a zone
    bool zones_grow_ = false;
    std::vector<uint8_t> is_fixed_;
    std::vector<Vec3> places_;  // room for untangle
    Untangle untangle_;
    std::span<const uint32_t> tangled_;
};

}  // namespace vfit
