// Pictures of the dressed avatar as it stands now.
#pragma once

#include "client/client.h"
#include "picture/canvas.h"
#include "picture/render.h"

namespace vfit::tools {

/// Avatar and garment as meshes to render, the skin under the garment left out. cloth may be null.
std::vector<RenderMesh> dressed_meshes(vfit_avatar avatar, vfit_cloth cloth);

struct PortraitStyle {
    int width, height;  // pixels
    int samples;        // a side of a pixel
};

/// A portrait of what stands about `centre` on the floor, seen from `yaw` (0: from the front).
Canvas draw_dressed(const std::vector<RenderMesh>& meshes, const glm::vec3& centre, float yaw,
                    const PortraitStyle& style);

/// Middle of the mesh over the floor.
glm::vec3 centre_of(const RenderMesh& mesh);

}  // namespace vfit::tools
