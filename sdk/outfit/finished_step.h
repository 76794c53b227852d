// What the last finished step of a cloth left, apart from what a running step works on.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/garment/carry.h"
#include "core/jobs.h"
#include "math/types.h"
#include "outfit/cloth_piece.h"

namespace vfit {

class FinishedStep {
public:
    /// Of that pose (skinning matrices, one a rig bone). Does not allocate after the first call.
    void keep(const ClothPiece& cloth, std::span<const Mat4> pose, int64_t time_ns, bool with_pressure);

    const std::vector<Vec3>& positions() const { return positions_; }
    const std::vector<Vec3>& normals() const { return normals_; }
    const std::vector<float>& strain() const { return strain_; }
    const std::vector<float>& pressure() const { return pressure_; }  // empty: not asked for
    std::span<const Mat4> pose() const { return pose_; }
    int64_t time_ns() const { return time_ns_; }

    /// With the pose taken out.
    Carry::Unposed unposed(const Carry& carry, Jobs& jobs) const;

    /// The same cloth in another pose; valid until the next call. Does not allocate after the first call.
    struct Reskinned {
        const std::vector<Vec3>&positions, &normals;
    };
    Reskinned reskin(const Carry& carry, std::span<const Mat4> pose, int64_t time_ns, Jobs& jobs);

    /// The step, or the same cloth in the pose that it was reskinned to since.
    struct Shown {
        const std::vector<Vec3>& positions;
        std::span<const Mat4> pose;
        int64_t time_ns;
    };
    Shown shown() const;

private:
    std::vector<Vec3> positions_, normals_;
    std::vector<float> strain_, pressure_;
    std::vector<Mat4> pose_;
    int64_t time_ns_ = 0;
    Carry::Unposed unposed_;  // made when first reskinned
    bool is_unposed_ = false;
    std::vector<Vec3> reskinned_positions_, reskinned_normals_;
    std::vector<Mat4> reskinned_pose_;
    int64_t reskinned_time_ns_ = 0;
    bool is_reskinned_ = false;  // since the step
};

}  // namespace vfit
