// Spheres and tapered capsules as meshes to look at.
#pragma once

#include "client/client.h"
#include "picture/render.h"

namespace vfit::tools {

std::vector<vfit_collider> colliders_of(vfit_avatar avatar);

/// The spheres in one mesh, the capsules in another.
std::vector<RenderMesh> collider_meshes(const std::vector<vfit_collider>& colliders);

}  // namespace vfit::tools
