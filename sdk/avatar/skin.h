// Skinning: how much each bone carries of each vertex, and the posed skin, written straight into the memory
// of whoever wants it, in their axes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "avatar/rig.h"
#include "avatar/skin_kernels.h"
#include "body/body_model.h"
#include "core/jobs.h"
#include "frame/axes.h"

namespace vfit {

using SkinBones = std::array<uint16_t, kSkinBones>;
using SkinWeights = std::array<float, kSkinBones>;

/// Divides what the bones of each limb carry of a vertex linearly along the limb (Fig. 6 of the paper): all
/// on the original bone at the near joint, all on the extension at the far one. Weights are sorted, heaviest
/// first, and sum to 1.
void split_limb_weights(std::span<const Vec3> rest, std::span<const LimbChain> limbs,
                        std::span<SkinBones> bones, std::span<SkinWeights> weights);

enum class SkinMethod {
    linear,          // linear blend skinning: what engines do
    dual_quaternion  // keeps the section of a joint that twists or bends far; bulges a little where it bends
};

/// Where vertices go: item i at data + i * stride bytes, three floats each.
struct SkinTarget {
    void* positions = nullptr;
    size_t position_stride = sizeof(Vec3);
    void* normals = nullptr;  // null: none are made
    size_t normal_stride = sizeof(Vec3);
};

class Skin {
public:
    /// One of each a vertex; zero weights are left out, the others sum to 1. rest_normals may be empty: none
    /// can be asked for then. VFIT_ERROR_DATA where no bone carries a vertex.
    Skin(std::span<const SkinBones> bones, std::span<const SkinWeights> weights, std::span<const Vec3> rest,
         std::span<const Vec3> rest_normals);

    uint32_t vertex_count() const { return static_cast<uint32_t>(starts_.size()) - 1; }
    uint32_t bone_count() const { return bone_count_; }  // the highest in use + 1
    /// What one call reads of the skin, in bytes; beside it, only what it writes.
    size_t bytes() const;

    /// Room for the bones of one call; kept by the caller so that none allocates.
    using Scratch = std::vector<float>;

    /// Posed positions and unit normals of all vertices in the host's axes; matrices are rigid, world = M *
    /// rest. Does not allocate once `scratch` has served a call. VFIT_ERROR_ARGUMENT where there are too few
    /// matrices.
    void pose(std::span<const Mat4> matrices, SkinMethod method, const Axes& axes, const SkinTarget& target,
              Scratch& scratch, Jobs& jobs) const;

    /// Linearly blended positions in world space alone. out is resized once.
    void carry(std::span<const Mat4> matrices, std::vector<Vec3>& out, Scratch& scratch, Jobs& jobs) const;

private:
    // All in the order in which vertices are worked on: within a piece of work, those with few bones come
    // first, so that it can be foretold how many the next one has.
    std::vector<uint32_t> order_;  // vertices
    std::vector<uint32_t> starts_;
    std::vector<SkinInfluence> influences_;
    std::vector<Vec3> rest_;  // position of each, and its normal where there are any
    uint32_t bone_count_ = 0;
    bool has_normals_;
};

}  // namespace vfit
