// What kind of thing a contact mesh is, and how the cloth meets it.
#pragma once

#include <cstdint>
#include <span>

namespace vfit {

/// solid: the skin. Vertices are kept outside by planes (ContactMesh), which are followed from step to step,
/// also in its hollows. Crossings are not repaired: a skin that pinches the cloth would tear it. prop: a
/// solid with sharp edges; crossings are repaired (CrossingGuard).
enum class MeshOf : uint8_t { solid, prop };

/// Which vertices of a cloth a mesh is there for: those whose mask has a bit of the mesh vertex' category.
/// Empty: all meet all.
struct MeshFilter {
    std::span<const uint8_t> category;  // one a vertex of the mesh
    std::span<const uint8_t> mask;      // one a vertex of the cloth
};

}  // namespace vfit
