// Pictures of the dressed avatar as it stands now.
#pragma once

#include <span>

#include "client/client.h"
#include "client/outfit.h"
#include "picture/canvas.h"
#include "picture/render.h"

namespace vfit::tools {

constexpr Color kGarmentColor{0.80f, 0.27f, 0.30f};  // of garments that state none

/// What the garment is coloured by: nothing; how much it is stretched (blue: 5 % too long, red: 10 %); what
/// the body presses with against it (yellow: 0.5 kPa, red: 2 kPa; the cloth needs VFIT_CLOTH_PRESSURE); how
/// it sits (vfit_cloth_fit_map; red: tight, blue: loose).
enum class FitMap { none, stretch, pressure, fit };

/// A simulated garment, and the file that states its colors; without one it is painted in kGarmentColor.
struct DrawnCloth {
    vfit_cloth cloth{};
    vfit_garment garment{};
};

/// Meshes to render: the avatar without the skin that the garments hide, then each garment.
std::vector<RenderMesh> dressed_meshes(vfit_avatar avatar, std::span<const DrawnCloth> cloths,
                                       FitMap map = FitMap::none);

std::vector<DrawnCloth> drawn(const WornOutfit& outfit);

struct PortraitStyle {
    int width, height;  // pixels
    int samples;        // a side of a pixel
};
constexpr PortraitStyle kFinePortrait{420, 640, 3}, kDraftPortrait{280, 420, 1};

/// A portrait of what stands about `centre` on the floor, seen from `yaw` (0: from the front).
Canvas draw_dressed(const std::vector<RenderMesh>& meshes, const glm::vec3& centre, float yaw,
                    const PortraitStyle& style);

/// Middle of the mesh over the floor.
glm::vec3 centre_of(const RenderMesh& mesh);

}  // namespace vfit::tools
