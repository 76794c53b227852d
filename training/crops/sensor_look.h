// Makes a perfect window of depth look as if a real sensor and a real segmentation had made it: jittered
// edges, shadows, holes, noise, steps of depth, and a user map that cuts feet, keeps pieces of floor and
// loses parts.
#pragma once

#include <cstdint>
#include <vector>

#include "frame/depth_image.h"
#include "random.h"
#include "shot.h"

namespace vfit::training {

enum class Light { kStructured, kTimeOfFlight };

struct RealShot {
    Camera camera;
    std::vector<uint16_t> depth_mm;
    std::vector<uint8_t> users;  // 1: the person

    DepthImage image() const { return {depth_mm.data(), users.data(), camera}; }
};

/// `wall_m`: distance of the wall behind, along the optical axis. Things that are no `person` are often cut:
/// by what stands before them, by the plane that a part of them lay in.
void look_real(const Shot& shot, Light light, float wall_m, bool person, Random& random, RealShot& out);

}  // namespace vfit::training
