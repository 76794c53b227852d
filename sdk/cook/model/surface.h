// Makes a modelled garment whole: one surface of cloth, of which each side is of two triangles or of the
// border.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth/garment/garment.h"
#include "cook/model/model.h"

namespace vfit {

struct Surface {
    std::vector<Vec3> positions;    // metres
    std::vector<uint32_t> indices;  // three a triangle, all turned the same way
    // As those of Garment.
    std::vector<uint32_t> copies, corners;
    std::vector<Vec2> uvs;
    std::vector<GarmentPart> parts;
    std::vector<std::vector<uint32_t>> openings;  // vertices around each, the longest first
    std::vector<std::string> notes;               // of what was mended or left out

    float length_of(const std::vector<uint32_t>& opening) const;
};

/// unit_m: of the positions. Vertices at one place become one; polygons are cut into triangles; pieces of a
/// few triangles that are not joined to the others (buttons) are left out; holes that are no openings are
/// closed; triangles are turned the same way. VFIT_ERROR_DATA says what is no garment's mesh, and where.
Surface make_surface(const Model& model, float unit_m);

}  // namespace vfit
