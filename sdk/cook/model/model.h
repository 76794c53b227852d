// A garment as its author modelled it: polygons in space, of which nothing is known yet but that their
// numbers are numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "math/types.h"

namespace vfit {

inline constexpr uint32_t kNoUv = UINT32_MAX;

struct ModelMaterial {
    std::string name, texture;  // texture: a path as the author gave it, or "FILE#/images/N" where it lies
                                // inside of the file
    Vec3 color{0.8f};           // linear RGB
};

struct ModelCorner {
    uint32_t position, uv;  // uv: kNoUv where there is none
};

struct ModelFace {
    uint32_t first_corner, corner_count;
    uint32_t material;       // one past the last: none
    uint32_t group, number;  // for its name
};

struct Model {
    // More than any garment: what is read is kept within this, whatever a file says.
    static constexpr size_t kMostPositions = 1000000, kMostCorners = 6000000;

    std::vector<Vec3> positions;  // in the file's unit
    std::vector<Vec2> uvs;        // v = 0 at the top of the picture
    std::vector<ModelCorner> corners;
    std::vector<ModelFace> faces;
    std::vector<ModelMaterial> materials;
    std::vector<std::string> groups;  // "the face in line ", before its number
    std::vector<std::string> notes;   // of what was left out or not found

    std::string name_of(size_t face) const {
        return groups[faces[face].group] + std::to_string(faces[face].number);
    }
    std::string material_of(size_t face) const {
        return faces[face].material < materials.size() ? materials[faces[face].material].name : "";
    }
    /// VFIT_ERROR_DATA where there are more than any garment has.
    void check_count() const {
        if (positions.size() > kMostPositions)
            fail(VFIT_ERROR_DATA, "the file has more than ", kMostPositions, " vertices");
        if (corners.size() > kMostCorners)
            fail(VFIT_ERROR_DATA, "the faces of the file have more than ", kMostCorners, " corners");
    }
};

}  // namespace vfit
