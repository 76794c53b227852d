// Joints that a camera can have measured: those within its image.
#pragma once

#include "frame/body.h"
#include "frame/camera.h"

namespace vfit {

bool in_view(const Camera& camera, const Vec3& camera_space);

/// No camera has measured a joint outside its image: such joints, in camera space, are INFERRED at most.
void limit_states(Body& body, const Camera& camera);

}  // namespace vfit
