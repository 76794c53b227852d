// The part of the avatar's skin that a garment can touch, as a mesh.
#pragma once

#include <span>
#include <vector>

#include "avatar/skin.h"
#include "cloth/garment/dress.h"

namespace vfit {

/// Which parts of the arms cloth meets; through the others it passes.
struct ArmsMet {
    bool forearms = true, hands = true;
};

/// One a body vertex, 1: from a hand above the garment's upper edge to a foot's length below its hem, and the
/// arms.
std::vector<uint8_t> below_garment(const DressBody& body, std::span<const Vec3> garment, ArmsMet arms);

/// Of the skin as cloth meets it (wrapped_skin.h), what is below the garment.
struct SkinBelow {
    Skin skin;
    std::vector<uint32_t> indices;  // three a triangle
};
SkinBelow skin_below(const DressBody& body, std::span<const Vec3> wrapped, std::span<const uint8_t> below);

}  // namespace vfit
