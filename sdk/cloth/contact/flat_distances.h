// Distances along a cloth as it was cut, for vertices close to each other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/fabric/fabric.h"
#include "core/jobs.h"

namespace vfit {

class FlatDistances {
public:
    /// Within radius_m.
    FlatDistances(const FabricData& fabric, float radius_m, Jobs* jobs = nullptr);

    /// Along edges; infinite beyond the radius, 0 for vertices that share an edge.
    float between(uint32_t vertex, uint32_t other) const;

private:
    struct Neighbour {
        uint32_t vertex;
        float distance_m;
    };
    std::vector<uint32_t> first_;        // of each vertex
    std::vector<Neighbour> neighbours_;  // by rising vertices
};

}  // namespace vfit
