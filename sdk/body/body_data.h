// The content of the baked body binary (scripts/bake_body.py, write_binary), checked.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "body/subdivision.h"

namespace vfit {

inline constexpr uint32_t kLanes = 8;  // points of a block: x of all, y of all, z of all
inline constexpr uint32_t kBlockFloats = 3 * kLanes;
inline constexpr uint32_t kTileBlocks = 64;  // blocks of a tile: one bit each in a mask
inline constexpr uint32_t kTileFloats = kTileBlocks * kBlockFloats;
inline constexpr uint32_t kMaxAnchors = 4;
inline constexpr uint32_t kMaxFactors = 6;

/// Values of a parameter at which one hat function is 1; between two of them both change linearly.
struct Anchors {
    uint32_t count;
    std::array<float, kMaxAnchors> at;
};

/// A product of hat functions that scales a displacement field.
struct Term {
    struct Factor {
        uint16_t parameter, anchor;
    };
    uint32_t field, factor_count;
    std::array<Factor, kMaxFactors> factors;
};

struct BodyData {
    uint32_t vertex_count, point_count;  // points: the vertices, then head and tail of every bone
    uint32_t tile_count;
    std::vector<ShapeParameter> parameters;
    std::vector<Anchors> anchors;  // one a parameter
    std::vector<RigBone> bones;
    std::vector<BodyPart> bone_parts;
    std::vector<Quad> quads, uv_quads;
    std::vector<Vec2> uvs;
    std::vector<std::array<uint16_t, kSkinBones>> skin_bones;    // one a vertex
    std::vector<std::array<uint16_t, kSkinBones>> skin_weights;  // in 1/65535
    std::vector<Term> terms;
    std::vector<float> base;  // blocks of all tiles
    // Displacement fields, metres = scale * step. Blocks in which nothing moves are not stored: of each field
    // and tile the mask tells which are, the offset where they start.
    std::vector<float> scales;
    std::vector<uint64_t> masks;
    std::vector<uint32_t> offsets;
    std::vector<int16_t> steps;
};

/// VFIT_ERROR_IO, VFIT_ERROR_VERSION or VFIT_ERROR_DATA naming the file and the cause.
BodyData read_body_data(const std::string& path);

}  // namespace vfit
