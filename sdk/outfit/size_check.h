// Refuses a garment in a size in which it would have to stretch by more than its fabric gives.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "cloth/garment/dress.h"
#include "outfit/cloth_piece.h"
#include "outfit/garment_fit.h"
#include "outfit/wearable_garment.h"

namespace vfit {

/// A garment in a size, on a body.
struct SizedGarment {
    const WearableGarment& garment;
    const std::string& label;
    const Dress& dress;
    std::span<const Vec2> cut;  // of that size, one place an index
};

/// Before it is simulated. VFIT_ERROR_NOT_WEARABLE, naming the girth at which it does not close.
void check_closes(const SizedGarment& sized, std::span<const GirthLevel> levels);

struct TooSmall {
    float beyond;     // strain, more than is given there
    std::string why;  // a message
};
/// Of a garment with lengths of its own, after its cloth came to them: where the line through the crotch, a
/// tenth of the cloth, or a neck or armhole is stretched too far; of several the one that is furthest beyond.
std::optional<TooSmall> too_small(const SizedGarment& sized, const ClothPiece& cloth);

}  // namespace vfit
