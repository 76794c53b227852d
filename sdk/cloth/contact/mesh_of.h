// What kind of thing a contact mesh is.
#pragma once

#include <cstdint>

namespace vfit {

/// A solid keeps its hollows; the folds of a cloth come and go, and what was faced in them would hold on to
/// it. Cloth that is just coming out from below the other one pushes that along, and nobody minds where the
/// two go through each other.
enum class MeshOf : uint8_t { solid, cloth, coming_cloth };

}  // namespace vfit
