// Places that bones carry: linear blending with the heaviest bones of each.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "math/types.h"

namespace vfit {

class SkinnedPlaces {
public:
    /// One more. A weight for each bone, of which the heaviest are kept; false where none is above zero.
    bool add(const Vec3& rest, std::span<const float> bone_weights);
    /// The same of some bones by number.
    bool add(const Vec3& rest, const std::array<uint16_t, kSkinBones>& bones, const std::array<float, kSkinBones>& weights);

    size_t size() const { return rest_.size(); }
    const std::vector<Vec3>& rest() const { return rest_; }
    /// By skinning matrices, one a rig bone: VFIT_ERROR_ARGUMENT where there are too few. out is resized once; no other
    /// allocation.
    void skin(std::span<const Mat4> matrices, std::vector<Vec3>& out) const;

private:
    struct Influence {
        uint16_t bone;
        float weight;
    };
    bool add(const Vec3& rest, std::vector<Influence> list);

    std::vector<Vec3> rest_;
    std::vector<uint32_t> first_ = {0};  // influence of each place, and the end
    std::vector<Influence> influences_;
    uint32_t bone_count_ = 0;  // highest bone in use + 1
};

}  // namespace vfit
