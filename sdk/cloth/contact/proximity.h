// Pairs of triangles, of a cloth or of a cloth and a mesh, that come close to each other in a step, and which
// of them may have crossed on the way.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cloth/contact/contact_kernels.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/contact/triangle_patches.h"
#include "core/jobs.h"

namespace vfit {

class Proximity {
public:
    using Triangle = TrianglePatches::Triangle;
    using Pair = TrianglePatches::Pair;  // the first triangle is the cloth's
    /// Of the cloth's own triangles against each other; mesh k is surface k + 1.
    static constexpr uint32_t kSelf = 0;

    /// reach_m: pairs of the cloth's own triangles that are further apart are not close; 0: none are looked
    /// at. piece_of: one a vertex, where the cloth has several pieces; else empty.
    Proximity(std::span<const Vec3> positions, std::span<const uint32_t> indices, float reach_m,
              std::vector<uint8_t> piece_of = {});
    /// The same surfaces, no pairs.
    Proximity(const Proximity& other);
    Proximity& operator=(const Proximity&) = delete;
    Proximity(Proximity&&) = default;
    Proximity& operator=(Proximity&&) = default;
    /// Its vertices follow those of the cloth and of the meshes before. It is hidden.
    void add_mesh(size_t vertices, std::span<const uint32_t> indices, float reach_m, MeshOf what,
                  const MeshFilter& filter = {});
    /// positions: by which its triangles are grouped, the first time.
    void show_mesh(uint32_t mesh, std::span<const Vec3> positions);
    /// Of its filter, from the next find() on; of the cloth's vertices from `first` on.
    void set_mask(uint32_t mesh, std::span<const uint8_t> mask, uint32_t first) {
        std::copy(mask.begin(), mask.end(), surfaces_[mesh + 1].mask.begin() + first);
    }
    /// From the next find() on, these two pieces (or the one) pass through each other, or no longer do.
    void set_passing(size_t piece, size_t other, bool passing) {
        for (const auto& [a, b] : {std::pair(piece, other), std::pair(other, piece)})
            passes_[a] = (passes_[a] & ~(uint64_t(1) << b)) | uint64_t(passing) << b;
    }
    /// Whether all of several do.
    void pass_each_other(bool they_do) { all_pass_ = they_do; }
    /// It meets nothing, and its pairs are forgotten.
    void hide_mesh(uint32_t mesh);
    size_t vertex_count() const { return vertex_count_; }

    /// Finds the pairs within reach between both ends of the step, and classifies them; those with a solid
    /// are left to find_close(). Positions of all vertices. Does not allocate once it has met as many.
    void find(std::span<const Particle> begin, std::span<const Particle> end, Jobs& jobs);
    /// Marked vertices of the cloth (one flag a vertex) went elsewhere since: finds the pairs of the patches
    /// about them again.
    void find_again(std::span<const uint8_t> marked, std::span<const Particle> begin,
                    std::span<const Particle> end);
    /// Before for_close(), after find() and all of find_again().
    void find_close(std::span<const Particle> begin, std::span<const Particle> end, Jobs& jobs);
    /// Classifies anew the pairs with a marked vertex (one flag a vertex), as the vertices are now; all
    /// others count as certain. Pairs stay those that were found.
    void find_uncertain_of(std::span<const uint8_t> marked, std::span<const Particle> begin,
                           std::span<const Particle> end, Jobs& jobs);

    /// False where something moves so fast past the cloth that pairs may have been missed (kMaxWay_m).
    bool is_complete() const { return is_complete_; }
    /// Pairs that no axis separates at both ends of their ways, and the surface that the second is of: none
    /// of a solid.
    template <typename Body>
    void for_uncertain(Body&& body) const {
        for_bits(only_marked_, [](const TrianglePairs& pairs) { return pairs.uncertain; }, body);
    }
    /// Pairs that find() saw within the reach now, or after the same way again; none that share a vertex.
    template <typename Body>
    void for_close(Body&& body) const {
        for_bits(false, [](const TrianglePairs& pairs) { return pairs.close; }, body);
    }

private:
    struct Classified {
        std::vector<Pair> pairs;
        std::vector<TrianglePairs> batches;  // of these, eight by eight
    };
    struct Surface {
        float reach_m;
        bool is_shown;
        std::optional<MeshOf> what{};  // none: the cloth's
        uint32_t first_vertex = 0;
        std::vector<uint32_t> indices;            // until it is shown
        std::vector<uint8_t> category{}, mask{};  // of its vertices and the cloth's (MeshFilter)
        std::optional<TrianglePatches> patches;   // none: the cloth's, or it was not shown yet
        Classified all, of_marked;

        bool meets(const Pair& pair) const;
    };
    template <typename Bits, typename Body>
    void for_bits(bool of_marked, Bits&& bits, Body&& body) const;
    void look_for_missed(const Surface& surface);
    /// Removes those from `first` on that its filter, or the pieces, leave out.
    void filter(Surface& surface, size_t first) const;
    bool pieces_meet(const Pair& pair) const;
    static void classify_all(Classified& of, const Surface& surface, std::span<const Particle> begin,
                             std::span<const Particle> end, Jobs& jobs);

    TrianglePatches cloth_;
    std::vector<uint8_t> piece_of_;      // of each vertex; empty: there is one piece
    std::array<uint64_t, 64> passes_{};  // of each piece: bit k, piece k passes through it
    bool all_pass_ = false;              // through each other
    std::vector<Surface> surfaces_;
    size_t vertex_count_;
    std::vector<uint32_t> moved_;  // patches of the cloth
    bool only_marked_ = false, is_complete_ = true, are_classified_ = true;
};

template <typename Bits, typename Body>
void Proximity::for_bits(bool of_marked, Bits&& bits, Body&& body) const {
    for (uint32_t surface = 0; surface < surfaces_.size(); ++surface) {
        const Classified& of = of_marked ? surfaces_[surface].of_marked : surfaces_[surface].all;
        for (size_t i = 0; i < of.batches.size(); ++i)
            for (uint32_t left = bits(of.batches[i]); left; left &= left - 1)
                body(of.pairs[i * kLanes + size_t(std::countr_zero(left))], surface);
    }
}

}  // namespace vfit
