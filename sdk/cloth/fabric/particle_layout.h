// In which order the solver keeps the vertices of a fabric. A cloth is cut across into parts that threads
// work on side by side. A part has its vertices that move, in runs of kLanes neighbours, then copies of the
// fixed ones that they are joined to, then a particle that nothing is joined to. How many parts there are
// depends on the fabric alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/base/particle.h"

namespace vfit {

struct FabricData;

struct ParticleLayout {
    static constexpr uint32_t kNobody = UINT32_MAX;

    struct Part {
        uint32_t begin, moving_end, end;  // the first two are multiples of kLanes
        uint32_t spare() const { return end - 1; }
    };

    std::vector<uint32_t> vertex_of;    // of each particle; kNobody: fills up
    std::vector<uint32_t> particle_of;  // of each vertex; of a fixed one the first copy
    std::vector<Part> parts;
    uint32_t cut_spares = 0;  // one particle that nothing is joined to for each cut, kLanes apart

    uint32_t count() const { return uint32_t(vertex_of.size()); }
    uint32_t part_of(uint32_t particle) const;
    /// Of vertices that are joined, one of which moves: the part that holds those that do, or the cut between
    /// part k and part k + 1 as parts.size() + k.
    uint32_t group_of(std::span<const uint32_t> vertices, std::span<const float> inverse_mass) const;
    /// Parts, then the cuts between them.
    uint32_t group_count() const { return 2 * uint32_t(parts.size()) - 1; }
    uint32_t spare_of_group(uint32_t group) const;
    /// A vertex as that part knows it.
    uint32_t particle_in(uint32_t part, uint32_t vertex) const;
};

ParticleLayout lay_out(const FabricData& data);

}  // namespace vfit
