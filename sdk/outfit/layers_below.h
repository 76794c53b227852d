// The layers below a garment: garments that it is worn over, as meshes that its cloth does not
// cross.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "avatar/rig.h"
#include "cloth/cloth.h"
#include "cloth/garment/carry.h"
#include "math/types.h"
#include "outfit/outside_layers.h"

namespace vfit {

class WornGarment;

class LayersBelow {
public:
    /// The next layer. inner must outlive this.
    void add(const WornGarment& inner, Cloth& cloth);
    void remove_last(Cloth& cloth);
    const WornGarment& last() const { return *layers_.back().garment; }
    size_t count() const { return layers_.size(); }
    bool has(const WornGarment& garment) const;
    /// The garment is one of the layers, or below one of them.
    bool reach(const WornGarment& garment) const;

    /// A layer has been stepped to there, one position a vertex. Does not allocate after the first call.
    void see(size_t layer, std::span<const Vec3> positions);
    /// The meshes of all layers, to where they were seen last.
    void move(Cloth& cloth);
    /// Takes the pose in which they were seen out of them (skinning matrices, one a rig bone), and moves the
    /// meshes into others.
    void take_out(std::span<const Mat4> pose, Jobs& jobs);
    void put_in(std::span<const Mat4> pose, Cloth& cloth, Jobs& jobs);

    /// A cloth, outside of the layers from the `first` on, as the meshes were moved last. axes: one a rig
    /// bone.
    std::vector<Vec3> outside(size_t first, std::span<const BoneAxis> axes, const AboutBones& cloth,
                              float clearance_m) const;

private:
    struct Layer {
        const WornGarment* garment;
        uint32_t mesh;
        std::vector<Vec3> seen, moved;
        Carry::Unposed unposed;
    };
    std::vector<Layer> layers_;
    std::vector<Vec3> normals_;  // room to work in
};

}  // namespace vfit
