// Patches of neighbouring triangles of one surface, with boxes about them over the motion of one step: which
// triangles may come close to each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/base/particle.h"
#include "cloth/contact/contact.h"
#include "cloth/contact/contact_kernels.h"
#include "cloth/contact/surface_kernels.h"
#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

class TrianglePatches {
public:
    struct Triangle {
        uint32_t vertex[3];
        uint32_t number;  // in the mesh
        uint32_t patch;
        // The vertices, and the edges from vertex k to k + 1, that this triangle is the first to have: bit k.
        // Each primitive of the surface has one owner.
        uint8_t own_vertices, own_edges;
    };

    /// Three indices a triangle; positions by which triangles are grouped. first_vertex: of the surface in
    /// the arrays of positions that follow.
    TrianglePatches(std::span<const Vec3> positions, std::span<const uint32_t> indices,
                    uint32_t first_vertex = 0);

    /// Where the vertices are at both ends of the step. Does not allocate.
    void move(std::span<const Particle> begin, std::span<const Particle> end, Jobs& jobs);
    /// The same for patches with a marked vertex alone (one flag a vertex), which are listed, rising.
    void move_marked(std::span<const uint8_t> marked, std::span<const Particle> begin,
                     std::span<const Particle> end, std::vector<uint32_t>& moved);

    std::span<const Triangle> triangles() const { return triangles_; }

    struct Pair {
        const Triangle *first, *second;

        bool shares_vertex() const;
    };
    /// Way of all vertices.
    Bounds way() const { return moving_.way(); }
    /// Adds the pairs of triangles of this surface and of `other` whose boxes come within reach_m of each
    /// other between both ends, or would by moving on in the same way. On the same surface, adjacent patches
    /// whose normals lie in one cone do not meet (Volino and Magnenat-Thalmann 1994). The order of the pairs
    /// is the same for any number of threads.
    void find_pairs(const TrianglePatches& other, float reach_m, std::vector<Pair>& out, Jobs& jobs) {
        find_pairs(other, reach_m, nullptr, out, jobs);
    }
    /// The same for a solid: without triangles that lie before the other's plane, now and after the same way
    /// again. end: as for move().
    void find_pairs_with_solid(const TrianglePatches& solid, std::span<const Particle> end, float reach_m,
                               std::vector<Pair>& out, Jobs& jobs) {
        find_pairs(solid, reach_m, end.data(), out, jobs);
    }
    /// As find_pairs(): those pairs alone of which a triangle is of one of these patches of this surface,
    /// rising.
    void find_pairs_of(std::span<const uint32_t> patches, const TrianglePatches& other, float reach_m,
                       std::vector<Pair>& out);

private:
    struct Corners {
        uint32_t at[3][kLanes];
    };
    struct Share {
        std::vector<uint32_t> meeting;
        std::vector<Pair> pairs;
    };
    uint32_t begin_of(uint32_t patch) const { return patch == 0 ? 0 : ends_[patch - 1]; }
    void list_owners(size_t vertices);
    void list_adjacent(size_t vertices);
    bool are_adjacent(uint32_t patch, uint32_t other) const;
    bool in_one_cone(uint32_t patch, uint32_t other) const;
    void move_patch(std::span<const Particle> begin, std::span<const Particle> end, uint32_t patch);
    /// of_solid: places at the end, where the other is a solid.
    void find_pairs(const TrianglePatches& other, float reach_m, const Particle* of_solid,
                    std::vector<Pair>& out, Jobs& jobs);
    /// Patches of the other from `first` on.
    void find_meeting_patches(uint32_t patch, const TrianglePatches& other, uint32_t first, float reach_m,
                              float max_way_m, std::vector<uint32_t>& out) const;
    void meet(uint32_t patch, const TrianglePatches& other, uint32_t of_other, float reach_m,
              const Particle* of_solid, std::vector<Pair>& out) const;

    std::vector<Triangle> triangles_;  // patch by patch
    std::vector<uint32_t> ends_;       // of patches in these
    std::vector<Corners> corners_;     // of each patch's triangles
    std::vector<PatchShape> patches_;
    std::vector<PatchBoxes> boxes_;  // at the end
    MovingBoxes moving_;
    std::vector<uint32_t> first_adjacent_, adjacent_;  // patches that share a vertex with each, rising
    std::vector<Share> shares_;
};

}  // namespace vfit
