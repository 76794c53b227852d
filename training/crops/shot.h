// A window of a depth camera's image around one person: what a perfect camera would see.
#pragma once

#include <vector>

#include "body/mesh.h"
#include "frame/camera.h"

namespace vfit::training {

struct Shot {
    Camera camera;               // of the window: size and principal point are the window's
    std::vector<float> depth_m;  // 0: nobody
    std::vector<float> cosine;   // of the angle between the surface's normal and the line of sight

    size_t pixels() const { return depth_m.size(); }
    size_t index(int x, int y) const { return size_t(y) * camera.width + size_t(x); }
};

/// Draws the mesh (world space) as `camera` sees it, in a window of its projection and `margin` pixels more,
/// cut at the camera's image. False where fewer than 200 pixels see it.
bool take_shot(const Mesh& mesh, const Camera& camera, int margin, Shot& out);

}  // namespace vfit::training
