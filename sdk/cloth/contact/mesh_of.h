// What kind of thing a contact mesh is, and which cloth meets it.
#pragma once

#include <cstdint>
#include <span>

namespace vfit {

/// solid: the skin. Contacts are followed from step to step, also in its hollows. Crossings are not repaired:
/// a skin that pinches the cloth would tear it. prop: a solid with sharp edges; crossings are repaired.
/// cloth: an inner garment. Its folds come and go, so contacts are not followed; crossings are repaired.
/// coming_cloth: an inner garment that grows and pushes the outer one along; crossings are not repaired.
enum class MeshOf : uint8_t { solid, prop, cloth, coming_cloth };

inline bool is_cloth(MeshOf what) { return what == MeshOf::cloth || what == MeshOf::coming_cloth; }
/// Crossings at the end of a step are repaired (CrossingGuard).
inline bool is_guarded(MeshOf what) { return what == MeshOf::cloth || what == MeshOf::prop; }

/// Which vertices of a cloth a mesh is there for: those whose mask has a bit of the mesh vertex' category.
/// Empty: all meet all.
struct MeshFilter {
    std::span<const uint8_t> category;  // one a vertex of the mesh
    std::span<const uint8_t> mask;      // one a vertex of the cloth
};

}  // namespace vfit
