// What kind of thing a contact mesh is, and which cloth meets it.
#pragma once

#include <cstdint>
#include <span>

namespace vfit {

/// A solid keeps its hollows; the folds of a cloth come and go, and what was faced in them would hold on to
/// it. Cloth that is just coming out from below the other one pushes that along, and nobody minds where the
/// two go through each other.
enum class MeshOf : uint8_t { solid, cloth, coming_cloth };

/// Which vertices of a cloth a mesh is there for: those whose mask has a bit of the mesh vertex' category.
/// Empty: all meet all.
struct MeshFilter {
    std::span<const uint8_t> category;  // one a vertex of the mesh
    std::span<const uint8_t> mask;      // one a vertex of the cloth
};

}  // namespace vfit
