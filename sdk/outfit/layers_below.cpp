#include "outfit/layers_below.h"

#include <algorithm>

#include "cloth/contact/triangle_groups.h"
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

void LayersBelow::start_to_grow(std::span<const BoneAxis> axes, size_t first) {
    first_growing_ = first;
    for (size_t i = first; i < layers_.size(); ++i)
        layers_[i].on_bones = layers_[i].garment->dress().carry().on_axes(axes, layers_[i].seen);
}

/// Looked at in tenths: growing, they come out of the bones, so that they are inside until they cross. The
/// tenth before that is left to contact.
float LayersBelow::inside(std::span<const Vec3> positions, std::span<const uint32_t> indices, Jobs& jobs) {
    constexpr int kTenths = 10;
    TriangleGroups cloth(positions, indices);
    cloth.move(positions, jobs);
    std::vector<TrianglePair> crossed;
    int tenths = kTenths;
    for (const Layer& layer : growing()) {
        layer.grown.place(layer.seen, layer.on_bones, 1.0f, places_);
        TriangleGroups grown(places_, layer.grown.indices());
        for (int tenth = 0; tenth < tenths; ++tenth) {
            layer.grown.place(layer.seen, layer.on_bones, float(tenth) / float(kTenths), places_);
            grown.move(places_, jobs);
            cloth.find_crossings(grown, crossed, jobs);
            if (!crossed.empty()) tenths = tenth;
            crossed.clear();
        }
    }
    return std::max(0.0f, float(tenths - 2) / float(kTenths));
}

void LayersBelow::grow(float fraction, Cloth& cloth) {
    for (size_t i = 0; i < first_growing_; ++i) cloth.move_mesh(layers_[i].mesh, layers_[i].seen);
    for (const Layer& layer : growing()) {
        layer.grown.place(layer.seen, layer.on_bones, fraction, places_);
        cloth.move_mesh(layer.grown_mesh, places_);
    }
}

void LayersBelow::end_growth(Cloth& cloth) const {
    for (const Layer& layer : growing()) cloth.hide_mesh(layer.grown_mesh);
}

}  // namespace vfit
