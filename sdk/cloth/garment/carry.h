// Carry: simulated cloth taken along from one pose into another by the bones that carry its garment.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "avatar/skin.h"
#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

class Carry {
public:
    /// One of each a vertex; weights that are zero are left out, the others sum to 1.
    Carry(std::span<const SkinBones> bones, std::span<const SkinWeights> weights);

    uint32_t vertex_count() const { return static_cast<uint32_t>(starts_.size()) - 1; }

    struct Influence {
        uint32_t bone;
        float weight;
    };
    std::span<const Influence> of_vertex(uint32_t vertex) const {
        return std::span(influences_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
    }
    Mat4 blended(uint32_t vertex, std::span<const Mat4> matrices) const;
    uint32_t heaviest_bone(uint32_t vertex) const;
    /// The skinning blend of a vertex in the pose `to` times the inverse of that in the pose `from`.
    Mat4 motion(uint32_t vertex, std::span<const Mat4> from, std::span<const Mat4> to) const;

    /// Cloth with the pose in which it was simulated taken out. Kept by the caller, so that nothing allocates
    /// after the first call.
    struct Unposed {
        std::vector<Vec3> positions, normals;
        std::vector<uint8_t> by_heaviest;  // 1: by its heaviest bone alone
    };
    /// Matrices are skinning matrices, world = M * rest, one a rig bone.
    void take_out(std::span<const Mat4> matrices, std::span<const Vec3> positions,
                  std::span<const Vec3> normals, Unposed& out, Jobs& jobs) const;
    /// Into another pose, in world space; normals of unit length. Both have vertex_count() places. What was
    /// taken out with the same matrices up to one rigid motion is moved by that motion.
    void put_in(std::span<const Mat4> matrices, const Unposed& cloth, std::span<Vec3> positions,
                std::span<Vec3> normals, Jobs& jobs) const;

    /// One a vertex: within the bones that carry it, nearest to where it is; of several, by their weights.
    /// axes: one a rig bone.
    std::vector<Vec3> on_axes(std::span<const BoneAxis> axes, std::span<const Vec3> positions) const;

    /// VFIT_ERROR_ARGUMENT where these are too few.
    void check_matrices(std::span<const Mat4> matrices) const;

private:
    template <typename Vertex>
    void for_all(std::span<const Mat4> matrices, Jobs& jobs, const Vertex& vertex) const;

    std::vector<uint32_t> starts_;  // of a vertex in influences_
    std::vector<Influence> influences_;
    uint32_t bone_count_ = 0;  // the highest in use + 1
};

}  // namespace vfit
