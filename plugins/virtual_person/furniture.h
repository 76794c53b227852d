// Things that stand in a fitting room: a chair, a coat rack, a stool.
#pragma once

#include <string>
#include <vector>

#include "solids.h"

namespace vfit::virtual_person {

inline constexpr float kStoolHeight_m =
    0.45f;  // the usual seat height (DIN EN 1729, body height 1.6 to 1.9 m)

/// "chair, rack, stool", for messages.
std::string furniture_names();
/// Whether every part of "chair,rack" names a piece.
bool is_furniture(const std::string& list);
/// The pieces of the list about where a person stands: the chair on their left, the rack on their right, each
/// 0.9 m away; the stool behind their heels, turned with them, where motion=sit sits down.
std::vector<Solid> make_furniture(const std::string& list, const Vec3& stand, float facing_deg);

}  // namespace vfit::virtual_person
