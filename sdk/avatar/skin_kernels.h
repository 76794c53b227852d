// The hot loops of skinning, in SIMD: vertices from a list of bones with weights, written wherever the host
// wants.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vfit {

/// One bone's share of a vertex.
struct SkinInfluence {
    uint32_t offset;  // of the bone in the table of bones, in floats: 16 a bone
    float weight;
};

/// One call's work: items first..last of a skin. Positions and normals are three floats each; `rest` has the
/// position of each item, then its normal, or positions alone where no normals are wanted. What comes of
/// vertex v lies at data + v * stride bytes; normals may be null.
struct SkinJob {
    const uint32_t* order;            // the vertex that each item is
    const uint32_t* starts;           // of item i in influences: starts[i] to starts[i + 1]
    const SkinInfluence* influences;  // heaviest first
    const float* bones;
    const float* rest;
    size_t rest_floats;  // of a vertex: 6 or 3
    uint32_t first, last;
    unsigned char* positions;
    size_t position_stride;
    unsigned char* normals;
    size_t normal_stride;
};

/// Bones are 3x4 matrices as four columns of four floats, the fourth of no meaning.
void skin_linear(const SkinJob& job);
/// Bones are unit dual quaternions, eight floats (xyzw, then the dual part), after Kavan et al. 2007,
/// "Skinning with dual quaternions"; `map`, three columns of four floats, carries the result into the host's
/// axes.
void skin_dual_quaternion(const SkinJob& job, const float* map);

}  // namespace vfit
