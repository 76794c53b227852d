// The last word on a cloth's own layers, after a step. What crosses that did not cross before moves as one,
// the way it moves on the whole: rigid impact zones (Provot 1997; Bridson, Fedkiw and Anderson 2002,
// section 7.5), of what has crossed instead of what will touch. What crossed before is untangled.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/contact/untangle.h"
#include "cloth/fabric/fabric.h"

namespace vfit {

class CrossingGuard {
public:
    explicit CrossingGuard(const FabricData& fabric);

    /// From before to now, one place a vertex: changes `now` so that as little crosses as can be. cloth: has
    /// been moved to now. even_heaps: however much crosses; else cloth that lies in a heap is left to
    /// contact. Does not allocate once it has met as many crossings.
    void keep(std::span<const Vec3> before, std::span<Vec3> now, TriangleGroups& cloth, bool even_heaps,
              Jobs& jobs);
    /// Before a first step: moves what crosses apart, a few centimetres at most.
    void part(std::span<Vec3> places, TriangleGroups& cloth, Jobs& jobs);
    /// The vertices that it moved in the last call.
    std::span<const uint32_t> moved() const { return moved_; }
    /// Those of triangles that crossed in the last two steps: contact would hold them where they are.
    std::span<const uint32_t> tangled() const { return tangled_; }

private:
    bool crossed_before(const TrianglePair& pair, std::span<const Vec3> before) const;
    bool unite_crossed(std::span<const Vec3> before);
    void unite(uint32_t a, uint32_t b);
    uint32_t root(uint32_t vertex);
    void move_zones(std::span<const Vec3> before, std::span<Vec3> now);
    void move_zone(std::span<const uint32_t> zone, std::span<const Vec3> before, std::span<Vec3> now);

    std::span<const uint32_t> indices_;
    std::vector<uint8_t> is_fixed_;
    std::vector<TrianglePair> pairs_;
    std::vector<uint32_t> parent_;  // of each vertex in a zone
    std::vector<uint32_t> zoned_;   // vertices, zone by zone
    std::vector<uint32_t> fixed_;   // of a zone
    std::vector<Vec3> wanted_;
    Untangle untangle_;
    std::vector<uint32_t> moved_;
    std::span<const uint32_t> tangled_;
};

}  // namespace vfit
