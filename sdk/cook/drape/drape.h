// Sews placed panels together on a body and lets the garment fall to rest.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cloth/fabric/fabric_library.h"
#include "cook/drape/placement.h"
#include "cook/sew/sewn.h"
#include "core/jobs.h"

namespace vfit {

struct DrapeBody {
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    const MeshQuery* skin;   // of these
    Vec3 left_shoulder;      // joint
};

struct DrapeReport {
    HangsOn hangs_on = HangsOn::nothing;
    float raised_m = 0.0f;
    float widest_seam_m = 0.0f;  // before what it joins became one
    uint32_t skin_crossings = 0, self_crossings = 0;  // pairs of triangles, at rest
    float strain_p99 = 0.0f;
    double seconds = 0.0;
};

struct Draped {
    std::vector<Vec3> positions;  // one a sewn vertex
    std::vector<uint8_t> simulated;  // the same: 0 where the garment hangs on shoulders or waist and goes with the skin
    DrapeReport report;
};

struct DrapeSettings {
    float thickness_m = 0.004f;   // from skin to cloth
    std::function<void(const char* stage, const std::vector<Vec3>& panel_vertices)> watch;  // for pictures of the way
};

/// VFIT_ERROR_DATA, naming the stitch, where a seam does not close.
Draped drape(const Pattern& pattern, const SewnMesh& mesh, const FabricMaterial& material, const DrapeBody& body, const Placement& placement,
             const DrapeSettings& settings, Jobs& jobs);

}  // namespace vfit
