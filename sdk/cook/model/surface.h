// Makes a piece of a model whole: one surface of cloth, in its own lengths.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cloth/garment/garment.h"
#include "cook/model/pieces.h"

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

/// Holes of less than hole_m around are closed. VFIT_ERROR_DATA says what is no cloth, and where.
Surface make_surface(const Pieces& pieces, const Piece& piece, float hole_m);

/// How triangles in the order of their materials look; empty where the model has no materials.
std::vector<GarmentPart> parts_of(const Model& model, const std::vector<ModelTriangle>& triangles);

}  // namespace vfit
