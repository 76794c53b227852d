// Things of a shop and a home that are no people, as solids for a VirtualRoom: vfit-bench track --only
// furniture moves them in.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "bench/virtual_room.h"

namespace vfit::tools {

enum class Furniture {
    kSwivelChair,
    kChair,
    kArmchair,
    kStool,
    kClothesRack,
    kCoatStand,
    kBoxes,
    kPlant,
    kBust,
    kLamp,
    kTrolley,
    kRobot,
    kDoor,
    kCurtain,
    kMannequin,  // a person's surface: not of solids
};
inline constexpr uint32_t kFurnitureKinds = 15;
const char* name_of(Furniture kind);

/// One piece on the floor about the origin, its front to +Z. Sizes are drawn within those of common
/// furniture. A door has its hinge at the origin and hangs open along +X. Empty for a mannequin.
std::vector<VirtualRoom::Solid> make_furniture(Furniture kind, std::mt19937& random);

/// Turned about the vertical through the origin, then moved.
void place(const std::vector<VirtualRoom::Solid>& piece, float yaw_rad, const Vec3& by,
           std::vector<VirtualRoom::Solid>& out);

}  // namespace vfit::tools
