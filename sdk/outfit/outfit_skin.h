// The skin of an avatar as it is drawn below an outfit.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/jobs.h"
#include "math/types.h"
#include "outfit/skin_press.h"
#include "outfit/worn_garment.h"

namespace vfit {

class OutfitSkin {
public:
    /// Of that body, which must outlive this.
    explicit OutfitSkin(const Avatar& avatar) : avatar_(avatar) {}

    /// Render vertices, world space; valid until the next call.
    struct Drawn {
        const std::vector<Vec3>&positions, &normals;
        std::span<const Mat4> pose;  // skinning matrices
        int64_t time_ns;
        uint32_t crossing_pairs;  // of triangles that still cross
    };
    /// In the pose in which the first garment is shown, pressed in below all (skin_press.h), as they are
    /// shown. All are worn by this body. Does not allocate once it has met its largest number of crossings.
    Drawn below(std::span<WornGarment* const> outfit, Jobs& jobs);

private:
    const Avatar& avatar_;
    std::optional<SkinPress> press_;  // made when first asked for
    std::vector<PressingCloth> cloths_;
    std::vector<Vec3> positions_, normals_;
    Skin::Scratch scratch_;
};

}  // namespace vfit
