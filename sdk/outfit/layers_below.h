// The layers below a garment: garments that it is worn over, as meshes that its cloth stays outside of.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "avatar/rig.h"
#include "cloth/cloth.h"
#include "math/types.h"
#include "outfit/grown_below.h"

namespace vfit {

class WornGarment;

class LayersBelow {
public:
    /// The next layer. inner must outlive this.
    void add(const WornGarment& inner, Cloth& cloth);
    size_t count() const { return layers_.size(); }
    bool has(const WornGarment& garment) const;
    /// The garment is one of the layers, or below one of them.
    bool reach(const WornGarment& garment) const;

    /// A layer has been stepped to there, one position a vertex. Does not allocate after the first call.
    void see(size_t layer, std::span<const Vec3> positions);
    /// The meshes of all layers, to where they were seen last.
    void move(Cloth& cloth) const;
    void hide(Cloth& cloth) const;

    /// Layers from the `first` on grow from the bones (axes: one a rig bone) to where they were seen last:
    /// `fraction` of the way, from 0 to 1; those before are there. Grown from the skin, a skirt would come
    /// out of two legs, between which the garment hangs.
    void start_to_grow(std::span<const BoneAxis> axes, size_t first);
    /// Up to which fraction what grows lies inside of a cloth with these triangles.
    float inside(std::span<const Vec3> positions, std::span<const uint32_t> indices, Jobs& jobs);
    void grow(float fraction, Cloth& cloth);
    void end_growth(Cloth& cloth) const;

private:
    struct Layer {
        const WornGarment* garment;
        uint32_t mesh;
        GrownBelow grown;
        uint32_t grown_mesh;
        std::vector<Vec3> seen;
        std::vector<Vec3> on_bones;  // the vertices of `seen`, each within the bones that carry it
    };
    std::span<const Layer> growing() const { return std::span(layers_).subspan(first_growing_); }
    std::vector<Layer> layers_;
    size_t first_growing_ = 0;
    std::vector<Vec3> places_;
};

}  // namespace vfit
