// A model's triangles, and the pieces of them that hang together.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cook/model/model.h"

namespace vfit {

struct ModelTriangle {
    std::array<uint32_t, 3> vertex, uv;  // uv: kNoUv where there is none
    uint32_t face;                       // of the model
};

/// A model's triangles in metres: vertices at one place are one.
struct Soup {
    const Model* model;
    float unit_m;  // of the model's numbers
    std::vector<Vec3> places;
    std::vector<ModelTriangle> triangles;
    std::vector<std::string> notes;  // of what was mended or left out

    std::string name_of(const ModelTriangle& triangle) const { return model->name_of(triangle.face); }
    std::vector<uint32_t> indices() const;
};

/// VFIT_ERROR_DATA where a vertex lies far from all others: the garment would be a speck beside it.
void check_no_strays(const Model& model);

/// VFIT_ERROR_DATA says what is no mesh, and where. model must outlive it.
Soup make_soup(const Model& model, float unit_m);
/// Triangles without uvs. name: before their number. places: in metres.
Model model_of(const std::vector<Vec3>& places, const std::vector<std::array<uint32_t, 3>>& triangles,
               float unit_m, const char* name);
/// Of a model of triangles whose vertices are joined as they should be.
Soup soup_of_joined(const Model& model, float unit_m);

/// Each side is of two triangles, turned the same way, or of the border.
struct Piece {
    std::vector<ModelTriangle> triangles;
    std::vector<uint32_t> indices;
    std::vector<std::vector<uint32_t>> openings;  // vertices around each
    float area_m2 = 0.0f;
};

struct Pieces {
    const Model* model;
    float unit_m;              // of the model's numbers
    std::vector<Vec3> places;  // metres
    std::vector<Vec2> uvs;
    std::vector<Piece> list;         // the largest first
    std::vector<std::string> notes;  // of what was mended or left out

    std::string material_of(const Piece& piece) const {
        return model->material_of(piece.triangles.front().face);
    }
    std::string name_of(const Piece& piece) const { return model->name_of(piece.triangles.front().face); }
};

/// Triangles are turned the same way. VFIT_ERROR_DATA says what is no surface, and where.
Pieces make_pieces(const Soup& soup);

float area_of(const std::vector<Vec3>& places, const ModelTriangle& triangle);
/// "(0.1, 1.2, 0)".
std::string shown(const Vec3& place);

}  // namespace vfit
