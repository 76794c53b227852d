// In which order the solver keeps the vertices of a fabric: those that move first, in runs of kLanes neighbours, then the
// others, then one particle that nothing is joined to.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/particle.h"

namespace vfit {

struct DistanceConstraint;

struct ParticleLayout {
    static constexpr uint32_t kNobody = UINT32_MAX;

    std::vector<uint32_t> vertex_of;    // of each particle; kNobody: fills up a run
    std::vector<uint32_t> particle_of;  // of each vertex
    uint32_t moving = 0;                // particles that may move, a multiple of kLanes
    uint32_t spare = 0;                 // the particle that nothing is joined to

    uint32_t count() const { return uint32_t(vertex_of.size()); }
};

ParticleLayout lay_out(std::span<const float> inverse_mass, std::span<const DistanceConstraint> edges);

}  // namespace vfit
