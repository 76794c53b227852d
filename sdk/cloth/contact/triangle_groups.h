// Boxes about the triangles of a mesh that keeps its triangles and moves its vertices: which of them go
// through each other.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cloth/contact/contact.h"
#include "cloth/contact/surface_kernels.h"
#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

using TrianglePair = std::pair<uint32_t, uint32_t>;

struct Corners {
    Vec3 at[3];
};
/// Does one go through the other?
bool cross(const Corners& a, const Corners& b);

/// Groups of triangles that lie near each other.
class TriangleGroups {
public:
    /// Three indices a triangle; places by which they are grouped. Nowhere until it is moved.
    TriangleGroups(std::span<const Vec3> positions, std::span<const uint32_t> indices);

    /// Does not allocate.
    void move(std::span<const Vec3> positions, Jobs& jobs);

    /// Adds the pairs of triangles that cross and share no vertex. flat_do_not: groups, alone and with those
    /// beside them, whose triangles all face one way are taken not to cross (Volino and Thalmann 1994).
    void find_crossings(bool flat_do_not, std::vector<TrianglePair>& out, Jobs& jobs);
    /// Adds the pairs of a triangle of this mesh and one of the other that cross.
    void find_crossings(const TriangleGroups& other, std::vector<TrianglePair>& out, Jobs& jobs);

    struct Closest {
        Vec3 point, normal;  // of its triangle
        float distance;      // negative behind the surface; infinite: there is none within the reach
        uint32_t triangle;
    };
    /// The point of the surface that is closest to p. Does not allocate.
    Closest closest(const Vec3& p, float reach_m) const;

    uint32_t group_count() const { return uint32_t(normals_.size()); }
    Bounds box_of(uint32_t group) const { return {groups_.runs.low_of(group), groups_.runs.high_of(group)}; }
    /// Adds the triangles of a group that cross that one.
    void find_crossed(uint32_t group, const Corners& other, std::vector<uint32_t>& triangles) const;
    /// Adds all triangles that cross that one. met: scratch.
    void find_crossed(const Corners& other, std::vector<uint32_t>& met,
                      std::vector<uint32_t>& triangles) const;

private:
    static constexpr uint32_t kSize = 8;  // of a group, at most
    struct Triangle {
        uint32_t vertex[3];
        uint32_t number;  // in the mesh
    };
    /// Between two planes: thinner than a box where a group is nearly flat.
    struct Slab {
        Vec3 normal;
        float low, high;
        bool is_clear_of(const Corners& t) const;
    };
    uint32_t begin_of(uint32_t group) const { return group == 0 ? 0 : ends_[group - 1]; }
    struct Share {
        std::vector<uint32_t> near;  // groups that one meets
        std::vector<TrianglePair> pairs;
    };
    template <typename Body>
    void for_shares(Jobs& jobs, Body&& body);
    template <typename Find>
    void find_in_shares(Jobs& jobs, std::vector<TrianglePair>& out, Find&& find);
    void move_groups(std::span<const Vec3> positions, uint32_t begin, uint32_t end);
    void list_beside(size_t vertices);
    bool are_beside(uint32_t group, uint32_t other) const;
    bool face_one_way(uint32_t group, uint32_t other) const;
    struct Search;
    void search_block(uint32_t block, Search& search) const;
    void meet(uint32_t group, const TriangleGroups& other, uint32_t of_other,
              std::vector<TrianglePair>& out) const;

    std::vector<Triangle> triangles_;  // group by group
    std::vector<uint32_t> ends_;       // of groups in these
    std::vector<Corners> corners_;     // of these
    std::vector<Bounds> boxes_;        // of these
    RunBoxes groups_;
    std::vector<Bounds> normals_;                  // of groups, as long as their triangles are large
    std::vector<Slab> slabs_;                      // of groups
    std::vector<uint32_t> first_beside_, beside_;  // of each group, those that share a vertex with it, rising
    std::vector<Share> shares_;                    // of the work
};

}  // namespace vfit
