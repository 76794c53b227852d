// What kind of thing a contact mesh is, and which cloth meets it.
#pragma once

#include <cstdint>
#include <span>

namespace vfit {

/// A solid keeps its hollows; the folds of a cloth come and go, and what was faced in them would hold on to
/// it. A prop is a solid with sharp edges, of which the cloth is kept as it is of cloth; of a skin that
/// pinches it, it would tear. Cloth that is just coming out from below the other one pushes that along, and
/// nobody minds where the two go through each other.
enum class MeshOf : uint8_t { solid, prop, cloth, coming_cloth };

inline bool is_cloth(MeshOf what) { return what == MeshOf::cloth || what == MeshOf::coming_cloth; }
/// What ends a step through the cloth is set right (CrossingGuard).
inline bool is_guarded(MeshOf what) { return what == MeshOf::cloth || what == MeshOf::prop; }

/// Which vertices of a cloth a mesh is there for: those whose mask has a bit of the mesh vertex' category.
/// Empty: all meet all.
struct MeshFilter {
    std::span<const uint8_t> category;  // one a vertex of the mesh
    std::span<const uint8_t> mask;      // one a vertex of the cloth
};

}  // namespace vfit
