// Clothes as an uneven offset of the skin along its normals: a top with sleeves to the wrists and trousers to
// the ankles, each with folds of its own. The joints stay those of the body.
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

/// How thick clothes are, in metres.
struct Thickness {
    static constexpr float kUnsaid = -1.0f;
    float mean_m = 0.0f;  // of all; top and trousers differ from it by chance
    float top_m = kUnsaid, sleeves_m = kUnsaid, trousers_m = kUnsaid;  // where said, about this each

    bool by_zone() const { return top_m >= 0.0f || sleeves_m >= 0.0f || trousers_m >= 0.0f; }
    bool any() const { return mean_m > 0.0f || top_m > 0.0f || sleeves_m > 0.0f || trousers_m > 0.0f; }
    float top() const { return top_m >= 0.0f ? top_m : mean_m; }
    float sleeves() const { return sleeves_m >= 0.0f ? sleeves_m : mean_m; }
    float trousers() const { return trousers_m >= 0.0f ? trousers_m : mean_m; }
};

class Clothing {
public:
    /// `rest`: the skin in the T-pose, packed x, y, z. The mean offset of the covered surface is
    /// thickness.mean_m, unless zones have their own.
    Clothing(std::span<const float> rest, std::span<const uint32_t> triangles, const BodyLandmarks& landmarks,
             const Thickness& thickness, uint64_t seed);

    /// The dressed surface of the posed body, as long as it is not called again. `normals` as `skin`.
    const float* dress(const float* skin, const float* normals);

    /// One a vertex, metres; 0 where the skin is bare.
    std::span<const float> offsets_m() const { return offsets_m_; }

private:
    std::vector<float> offsets_m_, surface_;
    std::vector<uint32_t> same_place_;  // the first vertex at that place: seams of the texture double some
};

}  // namespace vfit::virtual_person
