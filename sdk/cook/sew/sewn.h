// The meshes of all panels, sewn together: which vertices become one, and which side is out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cook/mesh/panel_mesh.h"
#include "cook/pattern/pattern.h"

namespace vfit {

/// Vertices come in two kinds. Panel vertices are those of all panels one after another. Sewn vertices are
/// what is left when each seam has made one of two or more.
struct SewnMesh {
    std::vector<PanelMesh> panels;
    std::vector<uint32_t> first_vertex;  // of each panel, among panel vertices
    std::vector<uint32_t> sewn_of;       // of each panel vertex
    uint32_t sewn_count = 0;
    std::vector<uint32_t> panel_indices,
        sewn_indices;  // the same triangles, three indices each; counter-clockwise from one side all over
    std::vector<uint32_t> first_triangle;  // of each panel, and one past the last
    struct Pair {
        uint32_t a, b;  // panel vertices
        uint32_t stitch;
    };
    std::vector<Pair> pairs;  // that seams pull together

    uint32_t panel_vertex_count() const { return uint32_t(sewn_of.size()); }
    /// One a panel vertex.
    std::vector<Vec2> flat() const;
    /// The same of another size of the pattern. VFIT_ERROR_DATA where its panels or edges are others.
    std::vector<Vec2> flat_of_size(const Pattern& base, const Pattern& size) const;
};

/// length_m: of a triangle's side. VFIT_ERROR_DATA names the panel or stitch that cannot be meshed or sewn.
SewnMesh sew(const Pattern& pattern, float length_m);

}  // namespace vfit
