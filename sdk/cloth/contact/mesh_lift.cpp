#include "cloth/contact/mesh_lift.h"

#include <algorithm>

namespace vfit {

namespace {

constexpr float kStep_m = 0.0015f, kMaxLift_m = 0.03f;  // whole folds may have come through
constexpr float kForgets = 0.01f;                       // fraction, for each millimetre that a mesh moves
constexpr uint32_t kSteps = 16;                         // in which all triangles are looked at

}  // namespace

MeshLift::MeshLift(std::shared_ptr<const Fabric> fabric)
    : fabric_(std::move(fabric)), lift_m_(fabric_->layout().count(), 0.0f) {}

void MeshLift::forget(std::span<const ContactMesh> meshes) {
    float way_m = 0.0f;
    for (const ContactMesh& mesh : meshes)
        if (mesh.what() == MeshOf::cloth) way_m = std::max(way_m, mesh.greatest_way());
    const float keep = std::max(0.0f, 1.0f - kForgets * 1000.0f * way_m);
    if (keep < 1.0f)
        for (float& lift : lift_m_) lift *= keep;
}

void MeshLift::look(const TriangleGroups& cloth, std::span<const ContactMesh> meshes) {
    forget(meshes);
    const uint32_t count = cloth.group_count(), first = next_ >= count ? 0 : next_,
                   end = std::min(count, first + count / kSteps + 1);
    next_ = end;
    groups_.swap(looked_again_);
    for (uint32_t group = first; group < end; ++group)
        if (std::find(groups_.begin(), groups_.end(), group) == groups_.end()) groups_.push_back(group);
    looked_again_.clear();
    for (const uint32_t group : groups_) {
        crossed_.clear();
        for (const ContactMesh& mesh : meshes)
            if (mesh.what() == MeshOf::cloth) mesh.find_crossed(cloth, group, near_, crossed_);
        if (crossed_.empty()) continue;
        looked_again_.push_back(group);
        std::sort(crossed_.begin(), crossed_.end());
        crossed_.erase(std::unique(crossed_.begin(), crossed_.end()), crossed_.end());
        for (const uint32_t t : crossed_) {
            for (size_t k = 0; k < 3; ++k) {
                float& lift = lift_m_[fabric_->layout().particle_of[fabric_->data().indices[3 * t + k]]];
                lift = std::min(lift + kStep_m, kMaxLift_m);
            }
        }
    }
    groups_.clear();
}

}  // namespace vfit
