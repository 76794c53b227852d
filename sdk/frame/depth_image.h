// Views of the images of one frame, without ownership.
#pragma once

#include <cstdint>

#include "frame/camera.h"

namespace vfit {

/// Depth of one frame: U16 in units of camera.depth_unit_m, 0 = no reading; rows are tight.
struct DepthImage {
    const uint16_t* depth = nullptr;
    const uint8_t* users = nullptr;  // same size; 0 background, else a body's id; null: nobody marked
    Camera camera;

    uint32_t width() const { return camera.width; }
    uint32_t height() const { return camera.height; }
    size_t index(uint32_t x, uint32_t y) const { return size_t(y) * camera.width + x; }
    float metres(size_t i) const { return float(depth[i]) * camera.depth_unit_m; }
};

}  // namespace vfit
