// The near-regular triangle mesh of one flat panel.
#pragma once

#include <cstdint>
#include <vector>

#include "cook/mesh/triangulation.h"
#include "cook/pattern/pattern.h"

namespace vfit {

struct PanelMesh {
    std::vector<Vec2> flat;  // metres, in the panel
    Triangles triangles;     // as the panel's edges run: counter-clockwise from the garment's outside
    // Of each edge, its vertices from its begin to its end; a single one where the edge was too short to
    // keep.
    std::vector<std::vector<uint32_t>> edge_vertices;
    uint32_t outline = 0;  // the first so many vertices are the outline's
};

/// steps: of each edge, how many sides of triangles lie along it; 0: it is so short that both its ends become
/// one vertex. length_m: of a triangle's side. VFIT_ERROR_DATA names the panel.
PanelMesh mesh_panel(const Panel& panel, const std::vector<uint32_t>& steps, float length_m);

/// The same mesh on the same panel of another size: the outline goes where its edges went, the inside follows
/// it smoothly.
std::vector<Vec2> carry_to_size(const PanelMesh& mesh, const Panel& size);

}  // namespace vfit
