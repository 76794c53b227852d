// Which vertices are near each other along the flat cloth, and so no layers of it that could meet.
#pragma once

#include <cstdint>
#include <vector>

#include "cloth/contact/surface_kernels.h"
#include "cloth/fabric/fabric.h"
#include "core/jobs.h"

namespace vfit {

struct FlatNeighbours {
    std::vector<uint32_t> first;   // of each run of particles, in of_runs; and the end
    std::vector<NearRun> of_runs;  // by rising runs
};
/// Of each run, the vertices that are nearer than radius_m to one of it along the cloth; those that are
/// joined to it, or nearer than never_m, never count.
FlatNeighbours flat_neighbours(const Fabric& fabric, float radius_m, float never_m, Jobs* jobs = nullptr);

}  // namespace vfit
