#include "outfit/layers_below.h"

#include <algorithm>

#include "outfit/worn_garment.h"

namespace vfit {

void LayersBelow::add(const WornGarment& inner, Cloth& cloth) {
    const size_t vertices = inner.positions().size();
    const std::vector<uint32_t>& indices = inner.dress().indices();
    GrownBelow grown(vertices, indices);
    const uint32_t mesh = cloth.add_mesh(vertices, indices, {}, MeshOf::cloth);
    const uint32_t grown_mesh =
        cloth.add_mesh(grown.vertex_count(), grown.indices(), {}, MeshOf::coming_cloth);
    layers_.push_back({&inner, mesh, std::move(grown), grown_mesh, {}, {}});
}

bool LayersBelow::has(const WornGarment& garment) const {
    return std::any_of(layers_.begin(), layers_.end(),
                       [&](const Layer& layer) { return layer.garment == &garment; });
}

bool LayersBelow::reach(const WornGarment& garment) const {
    return std::any_of(layers_.begin(), layers_.end(), [&](const Layer& layer) {
        return layer.garment == &garment || layer.garment->layers().reach(garment);
    });
}

void LayersBelow::see(size_t layer, std::span<const Vec3> positions) {
    layers_[layer].seen.assign(positions.begin(), positions.end());
}

void LayersBelow::move(Cloth& cloth) const {
    for (const Layer& layer : layers_) cloth.move_mesh(layer.mesh, layer.seen);
}

void LayersBelow::hide(Cloth& cloth) const {
    for (const Layer& layer : layers_) cloth.hide_mesh(layer.mesh);
}

void LayersBelow::start_to_grow(std::span<const BoneAxis> axes) {
    for (Layer& layer : layers_) layer.on_bones = layer.garment->dress().carry().on_axes(axes, layer.seen);
}

void LayersBelow::grow(float fraction, Cloth& cloth) {
    for (const Layer& layer : layers_) {
        layer.grown.place(layer.seen, layer.on_bones, fraction, places_);
        cloth.move_mesh(layer.grown_mesh, places_);
    }
}

void LayersBelow::end_growth(Cloth& cloth) const {
    for (const Layer& layer : layers_) cloth.hide_mesh(layer.grown_mesh);
}

}  // namespace vfit
