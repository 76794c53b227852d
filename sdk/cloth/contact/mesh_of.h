// What kind of thing a contact mesh is.
#pragma once

#include <cstdint>

namespace vfit {

/// A solid keeps its hollows; the folds of a cloth come and go, and what was faced in them would hold on to it.
/// One that only just comes out from below the cloth pushes it along, and nobody minds where the two go through each other.
enum class MeshOf : uint8_t { solid, cloth, coming_cloth };

}  // namespace vfit
