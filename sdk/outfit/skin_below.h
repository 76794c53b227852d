// The part of the avatar's skin that a garment can touch, as a mesh.
#pragma once

#include <span>
#include <vector>

#include "avatar/creases.h"
#include "avatar/skin.h"
#include "cloth/garment/dress.h"
#include "outfit/contact_skin.h"

namespace vfit {

/// Parts of the arms that are obstacles; the others pass through the cloth.
struct ArmsMet {
    bool forearms = true, hands = true;
};

/// One flag a body vertex. 1: it lies between a hand's breadth above the garment's upper edge and a foot's
/// length below its hem, or on an arm that is an obstacle.
std::vector<uint8_t> below_garment(const DressBody& body, std::span<const Vec3> garment, ArmsMet arms);

/// The part of the collision proxy of the body that is below the garment.
struct SkinBelow {
    Skin skin;
    std::vector<uint32_t> indices;   // three a triangle
    Creases::Mesh creased;           // the same vertices
    std::vector<uint32_t> vertices;  // of the body: those whose bones carry them
};
/// `creases` are those of the body.
SkinBelow skin_below(const DressBody& body, const ContactSkin& skin, std::span<const uint8_t> below,
                     const Creases& creases);

}  // namespace vfit
