// A depth image as a person likes to see it, with the user map, the skeleton and the colliders over it.
#pragma once

#include "client/client.h"
#include "picture/canvas.h"

namespace vfit::tools {

/// Near is warm and light, far is dark; the person is tinted; no reading is black.
Canvas draw_depth(vfit_frame frame, int scale);

/// Bones between the seen joints of a body, over a picture of draw_depth.
void draw_skeleton(Canvas& canvas, vfit_frame frame, const std::vector<vfit_joint>& joints, int scale);

/// Collision spheres as circles and capsules as their outlines.
void draw_colliders(Canvas& canvas, vfit_frame frame, const std::vector<vfit_collider>& colliders, int scale);

}  // namespace vfit::tools
