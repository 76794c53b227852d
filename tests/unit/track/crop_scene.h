// A camera and a crop for tests of what is read from the network's maps.
#pragma once

#include "track/crop.h"

namespace vfit::testing {

inline Camera camera_320() {
    Camera camera;
    camera.width = 320, camera.height = 240;
    camera.fx = camera.fy = 285.0f;
    camera.cx = 159.5f, camera.cy = 119.5f;
    return camera;
}

/// About the middle of that camera's image, upright.
inline CropView view_at(float depth_m) {
    CropView view;
    view.centre = {160.0f, 120.0f};
    view.depth_m = depth_m;
    const float step = CropView::kSide_m / CropView::kPixels / depth_m * 285.0f;
    view.right = {step, 0.0f};
    view.down = {0.0f, step};
    return view;
}

}  // namespace vfit::testing
