// Clothes as an uneven offset of the skin along its normals: a top with sleeves to the wrists and trousers to the
// ankles, each with folds of its own. The joints stay those of the body.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "types.h"

namespace vfit::virtual_person {

/// Where one covers a body in the T-pose, world axes.
struct BodyLandmarks {
    float neck_y, waist_y, ankle_y, wrist_x;  // wrist_x: of the left one; the right one is at -wrist_x
    float shoulder_x;
};

class Clothing {
public:
    /// `rest`: the skin in the T-pose, packed x, y, z. The mean offset of the covered surface is `mean_m`.
    Clothing(std::span<const float> rest, std::span<const uint32_t> triangles, const BodyLandmarks& landmarks,
             float mean_m, uint64_t seed);

    /// The dressed surface of the posed body, as long as it is not called again. `normals` as `skin`.
    const float* dress(const float* skin, const float* normals);

    /// One a vertex, metres; 0 where the skin is bare.
    std::span<const float> offsets_m() const { return offsets_m_; }

private:
    std::vector<float> offsets_m_, surface_;
    std::vector<uint32_t> same_place_;  // the first vertex at that place: seams of the texture double some
};

}  // namespace vfit::virtual_person
