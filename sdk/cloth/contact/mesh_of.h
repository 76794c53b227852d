// What kind of thing a contact mesh is, and how the cloth meets it.
#pragma once

#include <cstdint>
#include <span>

namespace vfit {

/// solid: the skin. Vertices are kept outside by planes (ContactMesh), which are followed from step to step,
/// also in its hollows. Crossings are not repaired: a skin that pinches the cloth would tear it. prop: a
/// solid with sharp edges; crossings are repaired. cloth: another garment. It is met as the cloth's own
/// layers are: on the side where it is, whichever that is; crossings are repaired, and those that were there
/// before are moved apart.
enum class MeshOf : uint8_t { solid, prop, cloth };

/// Crossings at the end of a step are repaired (CrossingGuard).
inline bool is_guarded(MeshOf what) { return what != MeshOf::solid; }

/// Bits of a vertex. kOfItself: of triangles of the cloth that cross each other; two of these have no contact
/// while they are moved apart. kOfMeshes: of triangles of the cloth and another that cross; these may pass
/// each other, outwards. kGivesWay: stretched so far that other cloth may come through.
enum LetGo : uint8_t { kOfItself = 1, kOfMeshes = 2, kGivesWay = 4 };

/// Which vertices of a cloth a mesh is there for: those whose mask has a bit of the mesh vertex' category.
/// Empty: all meet all.
struct MeshFilter {
    std::span<const uint8_t> category;  // one a vertex of the mesh
    std::span<const uint8_t> mask;      // one a vertex of the cloth
};

}  // namespace vfit
