// Linear blend skinning: how much each bone carries of each vertex, and the posed skin.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "avatar/rig.h"
#include "body/body_model.h"
#include "core/jobs.h"

namespace vfit {

using SkinBones = std::array<uint16_t, kSkinBones>;
using SkinWeights = std::array<float, kSkinBones>;

/// Divides what the bones of each limb carry of a vertex linearly along the limb (Fig. 6 of the paper): all
/// on the original bone at the near joint, all on the extension at the far one. Weights are sorted, heaviest
/// first, and sum to 1.
void split_limb_weights(std::span<const Vec3> rest, const std::vector<LimbChain>& limbs,
                        std::span<SkinBones> bones, std::span<SkinWeights> weights);

/// The weights without their zeros, in the order that the hot loop reads them.
class Skin {
public:
    Skin(std::span<const SkinBones> bones, std::span<const SkinWeights> weights);

    uint32_t vertex_count() const { return static_cast<uint32_t>(first_.size()) - 1; }

    /// Posed positions and unit normals of all vertices. `normals` may be empty on both sides: then positions
    /// only. Does not allocate.
    void pose(std::span<const Mat4> matrices, std::span<const Vec3> rest, std::span<const Vec3> rest_normals,
              std::span<Vec3> positions, std::span<Vec3> normals, Jobs& jobs) const;

private:
    struct Influence {
        uint32_t bone;
        float weight;
    };
    std::vector<uint32_t> first_;  // of vertex i in influences_; one more at the end
    std::vector<Influence> influences_;
};

}  // namespace vfit
