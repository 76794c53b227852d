// What a garment file holds: a mesh authored on a body of one sex in its rest pose, which of its vertices
// are simulated, its fabric and its sizes. The format is described in docs/garments.md.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "anthropometry/measurement.h"
#include "body/mesh.h"
#include "body/shape_setting.h"
#include "cloth/fabric/fabric_library.h"
#include "cloth/garment/drawn_mesh.h"
#include "vfit.h"

namespace vfit {

/// One label of the garment's size table with the girths it is made for (keys as in measurement.h).
struct GarmentSize {
    std::string label;
    std::vector<Measurement> nominal;  // may be empty where the garment has a cut_shape
    std::vector<Vec2> flat;  // as Garment::flat, in this size; empty: the garment's cut_shape, or its shape's
                             // lengths times nominal over own girths
};

/// How triangles look; passed through to whoever draws them.
struct GarmentPart {
    std::string material, texture;  // texture: path of a picture as the author gave it; may be empty
    Vec3 color{0.8f};               // linear RGB, 0..1
    uint32_t first_triangle = 0, triangle_count = 0;
};

struct Garment {
    std::string name;
    std::string kind;        // garment kind of the size charts
    std::string size_chart;  // name of the chart that its labels follow; empty: not stated
    std::string fabric;      // name in the fabric library
    vfit_sex body_sex = VFIT_SEX_FEMALE;
    std::vector<ShapeSetting> body_shape;  // of the body that it was made on; empty: the default one
    Mesh mesh;  // positions on that body, indices, uvs (one a vertex, then one a copy)
    // Where panels are sewn together, renderers need a vertex for each: copies, numbered after the vertices.
    std::vector<uint32_t> copies;   // of each, the vertex that it is one of
    std::vector<uint32_t> corners;  // the triangles by vertices and copies, three each; empty: mesh.indices
    std::vector<Vec2>
        flat;  // empty, or one a vertex and copy: the triangles as they are cut from cloth, metres, y along
               // the warp: the garment's own lengths, in which positions were found
    std::vector<Vec3> cut_shape;  // empty, or one a vertex: a shape in space whose sides have the garment's
                                  // own lengths, of what was modelled and not cut; there is no flat then
    std::vector<uint8_t> on_arm;  // empty, or one a vertex: 1 carried by an arm
    DrawnMesh drawn;              // empty: what is simulated is drawn
    std::vector<GarmentPart> parts;  // of the triangles that are drawn; empty: one, without a name
    std::vector<uint8_t> simulated;  // one a vertex: 1 simulated, 0 skinned with the body
    std::vector<uint8_t> backstop;   // one a vertex: 1 kept out of the body below it
    std::vector<float> most_way;  // empty, or one a vertex: metres from where the skin would carry it; 0: any
    std::vector<GarmentSize> sizes;

    uint32_t vertex_count() const { return uint32_t(mesh.positions.size()); }
    uint32_t simulated_count() const;
    /// Other than those between its positions.
    bool has_own_lengths() const { return !flat.empty() || !cut_shape.empty(); }
    bool has_sleeves() const { return std::find(on_arm.begin(), on_arm.end(), uint8_t(1)) != on_arm.end(); }
    /// The simulated mesh as its uvs and flat places count it.
    uint32_t uv_count() const { return vertex_count() + uint32_t(copies.size()); }
    const std::vector<uint32_t>& uv_indices() const { return corners.empty() ? mesh.indices : corners; }
    uint32_t drawn_count() const { return drawn.empty() ? uv_count() : drawn.vertex_count(); }
    const std::vector<uint32_t>& drawn_indices() const {
        return drawn.empty() ? uv_indices() : drawn.indices;
    }
    const std::vector<Vec2>& drawn_uvs() const { return drawn.empty() ? mesh.uvs : drawn.uvs; }
    /// The size of that label; VFIT_ERROR_ARGUMENT, naming those that there are, where there is none.
    const GarmentSize& size(const std::string& label) const;
};

/// Reads a garment file (JSON, format "vfit-garment" version 1 to 4). Fails with VFIT_ERROR_DATA, naming the
/// field, vertex, triangle or edge; with VFIT_ERROR_VERSION where the version is a later one.
Garment parse_garment(std::span<const std::byte> json, const FabricLibrary& fabrics);

/// The checks of parse_garment on a garment made in memory.
void validate_garment(const Garment& garment, const FabricLibrary& fabrics);

/// Nominal girth of the label over the body's, mean of the keys that both have. Fails with
/// VFIT_ERROR_ARGUMENT for a label that the garment lacks, VFIT_ERROR_DATA where no key is common.
float size_ratio(const Garment& garment, const std::string& label, const std::vector<Measurement>& body);

}  // namespace vfit
