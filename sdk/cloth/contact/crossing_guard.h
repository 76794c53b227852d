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
    /// Vertices of a mesh follow, which do not give way either; three indices a triangle, of these. Crossings
    /// with guarded meshes are repaired by projections alone; other meshes are left to contact.
    void add_mesh(size_t vertices, std::span<const uint32_t> indices, MeshOf what);

    /// Changes `end` so that no triangles cross on linear ways from `begin`, except those that crossed at
    /// `begin` already: those of cloth are moved apart a little, those of a solid are left to contact.
    /// True: nothing crosses at the end, which is proven.
    bool keep(std::span<const Particle> begin, std::span<Particle> end, Proximity& proximity, Jobs& jobs);
    /// The cloth was placed anew: what crossed did so elsewhere.
    void forget() { tangles_.clear(), own_tangles_ = 0; }
    /// Moves triangles of cloth that cross apart, at rest.
    void part(std::span<Particle> places, Proximity& proximity, Jobs& jobs);

    /// Vertices that the last call moved, and whether as part of a zone: then their velocity is its.
    std::span<const uint32_t> moved() const { return moved_; }
    bool is_in_zone(uint32_t vertex) const { return parent_[vertex] != kNone; }
    /// In the last call, a triangle of the cloth crossed one of that guarded mesh at both ends.
    bool crosses_mesh(uint32_t mesh) const { return surfaces_[mesh + 1].is_crossed; }
    /// LetGo, one a vertex: of triangles that crossed at the begin, and still do, or that give way.
    std::span<const uint8_t> let_go() const { return let_go_; }
    /// From the next keep() on, that vertex of the cloth gives way to meshes of cloth, or no longer does.
    void give_way(uint32_t vertex, bool gives) {
        let_go_[vertex] = uint8_t(gives ? let_go_[vertex] | kGivesWay : let_go_[vertex] & ~kGivesWay);
    }

private:
    static constexpr uint32_t kNone = UINT32_MAX;
    struct Surface {
        MeshOf what;
        uint32_t first_vertex, first_triangle;  // in indices_
        bool is_crossed = false;                // at both ends
    };
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
    bool any_let_go(const Proximity::Triangle& t, uint8_t bits) const;
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
    const Surface& surface_of(const Proximity::Triangle& t) const;
    uint32_t number_of(const Proximity::Triangle& t) const;
    void mark(uint32_t vertex);
    void find_tangles(std::span<const Particle> places, Proximity& proximity, Jobs& jobs);
    void untangle_own(std::span<Particle> places, float step_m);
    void come_outwards(std::span<Particle> places, float step_m);
    void sort_tangles();
    std::span<const TrianglePair> own_tangles() const { return std::span(tangles_).first(own_tangles_); }
    std::span<const TrianglePair> other_tangles() const { return std::span(tangles_).subspan(own_tangles_); }
    bool is_own(const TrianglePair& pair) const;

    uint32_t cloth_vertices_;
    std::vector<float> inverse_mass_;
    std::vector<uint32_t> indices_;  // of the cloth's triangles, then of those of meshes of cloth
    std::vector<Hit> hits_;
    std::vector<std::pair<const Proximity::Triangle*, const Proximity::Triangle*>>
        crossed_;                        // at the end alone
    std::vector<TrianglePair> tangles_;  // of cloth at both ends, by their place in indices_
    size_t own_tangles_ = 0;             // those with itself, which come first
    bool crosses_mesh_ = false;          // at both ends, or it was not kept from it
    std::vector<Surface> surfaces_{{MeshOf::cloth, 0, 0}};  // the cloth's own first
    bool meets_cloth_ = false;  // of others: what moves own layers apart is guarded against these as well
    std::vector<uint8_t> is_marked_, is_moved_;  // in this round, in all
    std::vector<uint8_t> is_beyond_;             // of what found_at_ allows for
    std::vector<uint32_t> moved_;
    std::vector<Particle> wanted_;          // the end that the step made
    std::vector<Vec3> found_at_;            // where the pairs were found
    std::vector<Particle> parts_from_;      // of a round of part()
    std::vector<uint32_t> parent_, zoned_;  // of each vertex in a zone; those, zone by zone
    std::vector<uint32_t> numbers_;
    std::vector<Vec3> from_, to_;  // of a zone
    bool zones_grow_ = false;
    std::vector<uint8_t> is_fixed_;
    std::vector<Vec3> places_, outwards_;  // room for untangle; zero between calls
    Untangle untangle_;
    std::vector<uint8_t> let_go_;    // LetGo of each vertex
    std::vector<uint32_t> tangled_;  // those that are let go
};

}  // namespace vfit
