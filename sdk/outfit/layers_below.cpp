#include "outfit/layers_below.h"

#include <algorithm>

#include "body/mesh.h"
#include "outfit/worn_garment.h"

namespace vfit {

void LayersBelow::add(const WornGarment& inner, Cloth& cloth) {
    const size_t vertices = inner.positions().size();
    const std::vector<uint32_t>& indices = inner.dress().indices();
    layers_.push_back({&inner, cloth.add_mesh(vertices, indices, {}, MeshOf::cloth), {}, {}, {}});
}

void LayersBelow::remove_last(Cloth& cloth) {
    cloth.hide_mesh(layers_.back().mesh);
    layers_.pop_back();
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

void LayersBelow::move(Cloth& cloth) {
    for (Layer& layer : layers_) {
        layer.moved = layer.seen;
        cloth.move_mesh(layer.mesh, layer.moved);
    }
}

void LayersBelow::take_out(std::span<const Mat4> pose, Jobs& jobs) {
    for (Layer& layer : layers_) {
        const Dress& dress = layer.garment->dress();
        compute_normals(layer.seen, dress.indices(), normals_);
        dress.carry().take_out(pose, layer.seen, normals_, layer.unposed, jobs);
    }
}

void LayersBelow::put_in(std::span<const Mat4> pose, Cloth& cloth, Jobs& jobs) {
    for (Layer& layer : layers_) {
        layer.moved.resize(layer.seen.size()), normals_.resize(layer.seen.size());
        layer.garment->dress().carry().put_in(pose, layer.unposed, layer.moved, normals_, jobs);
        cloth.move_mesh(layer.mesh, layer.moved);
    }
}

std::vector<Vec3> LayersBelow::outside(size_t first, std::span<const BoneAxis> axes, const AboutBones& cloth,
                                       float clearance_m) const {
    std::vector<std::vector<Vec3>> on_bones;
    std::vector<AboutBones> below;
    on_bones.reserve(layers_.size());
    for (const Layer& layer : std::span(layers_).subspan(first)) {
        const Dress& dress = layer.garment->dress();
        on_bones.push_back(dress.carry().on_axes(axes, layer.moved));
        below.push_back({layer.moved, dress.indices(), on_bones.back()});
    }
    return outside_of(below, cloth, clearance_m);
}

}  // namespace vfit
