// Keeps a cloth from crossing itself and meshes: the ways of all vertices through a step are certified by
// continuous collision detection, and changed where two triangles would touch. First single contacts are
// projected; what that does not solve moves as one, in rigid impact zones (Provot 1997; Bridson, Fedkiw,
// Anderson 2002).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cloth/contact/contact_pair.h"
#include "cloth/contact/length_limit.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/contact/proximity.h"
#include "cloth/contact/triangle_groups.h"
#include "cloth/contact/untangle.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

class CrossingGuard {
public:
    /// Vertices without a finite mass do not give way.
    explicit CrossingGuard(const Fabric& fabric);
    /// Vertices of a mesh follow, which do not give way either. Crossings
    /// with props are repaired by projections alone; those with solids are left to contact.
    void add_mesh(size_t vertices, MeshOf what);

    /// Changes `end` so that no triangles cross on linear ways from `begin`, except those that crossed at
    /// `begin` already: those of cloth are moved apart a little, those of a mesh are left to contact.
    /// True: nothing crosses at the end, which is proven.
    /// shortens_m: as of LengthLimit; without it edges have no limit.
    bool keep(std::span<const Particle> begin, std::span<Particle> end, Proximity& proximity, Jobs& jobs,
              std::optional<float> shortens_m = {});
    void accept_lengths(std::span<const Particle> at) { length_limit_.accept(at); }
    /// The cloth was placed anew: what crossed did so elsewhere.
    void forget() { tangles_.clear(), own_tangles_ = 0; }
    /// Moves triangles of the cloth that cross apart, at rest. guarded: not through other layers meanwhile.
    void part(std::span<Particle> places, bool guarded, Proximity& proximity, Jobs& jobs);

    /// Vertices that the last call moved, and whether as part of a zone: then their velocity is its.
    std::span<const uint32_t> moved() const { return moved_; }
    bool is_in_zone(uint32_t vertex) const { return parent_[vertex] != kNone; }
    /// In the last call, a triangle of the cloth crossed one of that prop at both ends.
    bool crosses_mesh(uint32_t mesh) const { return meshes_[mesh].is_crossed; }
    /// Flags, one a vertex: of triangles of the cloth that crossed at the begin, and still do.
    std::span<const uint8_t> tangled() const { return is_tangled_; }

private:
    static constexpr uint32_t kNone = UINT32_MAX;
    struct Mesh {
        MeshOf what;
        bool is_crossed = false;  // at both ends
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
    bool may_pass(const Proximity::Pair& pair) const;
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
    bool is_of_cloth(const Proximity::Triangle& t) const { return t.vertex[0] < cloth_vertices_; }
    void mark(uint32_t vertex);
    void mark(std::span<const uint32_t> vertices);
    void find_tangles(std::span<const Particle> places, Proximity& proximity, Jobs& jobs);
    void untangle(std::span<Particle> places, float step_m);
    void come_outwards(std::span<Particle> places, float step_m);
    void sort_tangles();
    /// Of a piece with itself, and of two pieces.
    std::span<const TrianglePair> own_tangles() const { return std::span(tangles_).first(own_tangles_); }
    std::span<const TrianglePair> other_tangles() const { return std::span(tangles_).subspan(own_tangles_); }
    uint8_t piece_of(uint32_t triangle) const { return piece_of_[indices_[3 * triangle]]; }

    uint32_t cloth_vertices_;
    LengthLimit length_limit_;
    std::vector<float> inverse_mass_;
    std::vector<uint32_t> indices_;  // of the cloth's triangles
    std::vector<uint8_t> piece_of_;  // of the cloth's vertices
    bool has_pieces_;  // then what moves layers apart is guarded: else it would go through other pieces
    std::vector<Hit> hits_;
    std::vector<std::pair<const Proximity::Triangle*, const Proximity::Triangle*>>
        crossed_;                        // at the end alone
    std::vector<TrianglePair> tangles_;  // of the cloth at both ends, by their numbers
    size_t own_tangles_ = 0;             // those of a piece with itself, which come first
    bool crosses_mesh_ = false;          // at both ends, or it was not kept from it
    std::vector<Mesh> meshes_;
    std::vector<uint8_t> is_marked_, is_moved_;  // in this round, in all
    std::vector<uint8_t> is_zoned_;              // in a zone of any size
    std::vector<uint8_t> is_beyond_;             // of what found_at_ allows for
    std::vector<uint8_t> goes_back_;             // the zone of that root
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
    std::vector<uint8_t> is_tangled_;
    std::vector<uint32_t> tangled_;  // those vertices
};

}  // namespace vfit
