#include "outfit/outfit_skin.h"

namespace vfit {

OutfitSkin::Drawn OutfitSkin::below(std::span<WornGarment* const> outfit, Jobs& jobs) {
    const BodyTopology& topology = avatar_.topology();
    const std::vector<Vec3>& rest = avatar_.rest().positions;
    if (!press_) press_.emplace(std::span(rest).first(topology.vertex_count), topology.indices);
    positions_.resize(rest.size()), normals_.resize(rest.size());
    SkinTarget target;
    target.positions = positions_.data(), target.normals = normals_.data();
    const FinishedStep::Shown shown = outfit.front()->finished().shown();
    avatar_.skin_in(shown.pose, target, Axes(), scratch_, jobs);
    cloths_.clear();
    for (WornGarment* garment : outfit) cloths_.push_back(garment->shown_surface());
    const SkinPress::Result pressed =
        press_->press(cloths_, normals_, std::span(positions_).first(topology.vertex_count), jobs);
    for (size_t i = 0; i < topology.seam_sources.size(); ++i)
        positions_[topology.vertex_count + i] = positions_[topology.seam_sources[i]];
    return {positions_, normals_, shown.pose, shown.time_ns, pressed.left_pairs};
}

}  // namespace vfit
