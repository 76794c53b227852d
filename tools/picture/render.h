// Preview pictures of meshes: an Embree ray tracer with a soft key light, sky light and a studio floor.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "picture/canvas.h"

namespace vfit::tools {

/// World space: metres, Y up, counter-clockwise from outside.
struct RenderMesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<uint32_t> indices;
    Color color;
    std::vector<Color> vertex_colors;  // empty, or one a vertex in place of color
    float sheen = 0.0f;                // light that grazing cloth scatters towards the eye, 0..1
};

struct RenderView {
    glm::vec3 eye{0, 1.2f, 4.0f}, target{0, 0.95f, 0};
    float fov_y_rad = 0.5f;
    int width = 600, height = 900;
    int samples = 3;  // a side of a pixel: samples x samples rays
    bool floor = true;
};

/// Moves the eye away from the target, along its own line of sight, until all vertices are inside the
/// picture.
void step_back_to_show(const std::vector<RenderMesh>& meshes, RenderView& view);

Canvas render(const std::vector<RenderMesh>& meshes, const RenderView& view);

}  // namespace vfit::tools
