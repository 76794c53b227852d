// Pictures of the dressed avatar as it stands now.
#pragma once

#include "client/client.h"
#include "picture/canvas.h"
#include "picture/render.h"

namespace vfit::tools {

/// What the garment is coloured by: nothing; how much it is stretched (blue: 5 % too long, red: 10 %); what
/// the body presses with against it (yellow: 0.5 kPa, red: 2 kPa; the cloth needs VFIT_CLOTH_PRESSURE); how
/// it sits (vfit_cloth_fit_map; red: tight, blue: loose).
enum class FitMap { none, stretch, pressure, fit };

/// Avatar and garment as meshes to render, the skin under the garment left out. cloth may be null.
std::vector<RenderMesh> dressed_meshes(vfit_avatar avatar, vfit_cloth cloth, FitMap map = FitMap::none);

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
