// The common cloth scene (a dress over moving capsules, mesh.bin and motion_<scene>.bin), run by Cloth.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "body/collider.h"
#include "cloth/cloth.h"

namespace vfit::bench {

struct ClothScene {
    std::vector<Vec3> rest;
    std::vector<uint32_t> pins;
    std::shared_ptr<const Fabric> fabric;
    std::vector<std::vector<Collider>> colliders;  // one list a frame; frame 0 is the rest state
    std::vector<std::vector<Vec3>> pin_places;     // one list a frame

    uint32_t frame_count() const { return uint32_t(colliders.size()); }
};

/// VFIT_ERROR_IO where a file cannot be read, VFIT_ERROR_DATA where it is cut or does not fit.
ClothScene load_cloth_scene(const std::string& folder, const std::string& scene);

struct ClothRun {
    std::vector<double> frame_ms;  // frames 1..
    ClothStats last;
};

/// All frames at that number of sub-steps, layers kept that far apart; `frame` gets the positions after each.
ClothRun run_cloth_scene(const ClothScene& scene, uint32_t substeps, float self_thickness_m, Jobs& jobs,
                         const std::function<void(std::span<const Vec3>)>& frame);

}  // namespace vfit::bench
